// The runtime and the headset that it drives: an instance, asked for with what is used here.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "xr/api.h"
#include "xr/session.h"

namespace xr {

class Runtime {
 public:
    // With those of `extensions` that the runtime has. Says in one sentence why there is no runtime
    // or no headset.
    static std::variant<Runtime, NoHeadset> open(const std::vector<const char*>& extensions);
    Runtime(Runtime&& other) noexcept;
    Runtime& operator=(Runtime&&) = delete;
    ~Runtime() { close(); }
    // Destroys the instance and all that belongs to it, once.
    void close();

    XrInstance instance() const { return instance_; }
    XrSystemId system() const { return system_; }
    const std::string& name() const { return name_; }  // "Monado(XRT) by Collabora et al 25.0.0"
    bool has(const char* extension) const;             // asked for, and there
    // An extension's function. Throws LostError when it is missing.
    template <typename Function>
    Function function(const char* name) const {
        PFN_xrVoidFunction found = nullptr;
        check(xrGetInstanceProcAddr(instance_, name, &found), name);
        return reinterpret_cast<Function>(found);
    }
    XrPath path(const std::string& text) const;

    // Throws LostError with the call and its answer when it failed.
    void check(XrResult result, const char* call) const;
    // Nothing is destroyed any more: it may never return.
    void abandon() { instance_ = XR_NULL_HANDLE; }

 private:
    explicit Runtime(XrInstance instance) : instance_(instance) {}
    XrInstance instance_;
    XrSystemId system_ = XR_NULL_SYSTEM_ID;
    std::string name_;
    std::vector<std::string> enabled_;
};

}  // namespace xr
