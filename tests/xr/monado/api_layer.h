// The API layer of the tests (api_layer.cpp) between whoever opens a headset, also a program that
// is started, and the runtime, while this lives.
#pragma once

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "tests/support/variable.h"
#include "tests/xr/monado/submitted_view.h"

namespace tests {

class ApiLayer {
 public:
    static bool isBuilt() { return std::filesystem::exists(API_LAYER_FOLDER "/layer.json"); }
    static constexpr const char* kNotBuilt =
        "OpenXR is older than 1.0.33 here: it has no header for API layers";
    // REQUIRES: isBuilt(). `pretence`: one of submitted_view.h, or "" to look on only.
    explicit ApiLayer(const char* pretence = "")
        : record_(testFolder() / "submitted"), pretence_(kPretenceVariable, pretence) {}

    // What the compositor was given: the left eye's, the right eye's, again of each frame.
    std::vector<SubmittedView> submitted() const {
        const std::string bytes = readBytes(record_);
        std::vector<SubmittedView> views(bytes.size() / sizeof(SubmittedView));
        std::memcpy(views.data(), bytes.data(), views.size() * sizeof(SubmittedView));
        return views;
    }

 private:
    std::filesystem::path record_;
    Variable pretence_;
    Variable recordVariable_{kRecordVariable, record_};
    Variable folder_{"XR_API_LAYER_PATH", API_LAYER_FOLDER};
    Variable name_{"XR_ENABLE_API_LAYERS", API_LAYER};
};

}  // namespace tests
