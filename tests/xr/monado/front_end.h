// The headset's front end with a real runtime, for tests.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <variant>

#include "app/headset/headset.h"
#include "tests/support/monado_service.h"
#include "tests/support/remote_devices.h"
#include "tests/support/scripted_exploration.h"
#include "tests/ui/waiting.h"

namespace app::headset {

class FrontEnd : public testing::Test {
 protected:
    void open() {
        auto opened = Headset::open(world_.exploration, exporting_);
        if (const auto* none = std::get_if<xr::NoHeadset>(&opened)) FAIL() << none->why;
        headset_ = std::get<std::unique_ptr<Headset>>(std::move(opened));
    }
    template <typename Holds>
    void framesUntil(const Holds& holds) {
        const auto end = std::chrono::steady_clock::now() + ui::kDeadline;
        while (!holds()) {
            ASSERT_TRUE(headset_->frame());
            ASSERT_LT(std::chrono::steady_clock::now(), end);
        }
    }
    glm::dvec3 volume() const {
        return headset_->interaction().placement().stageFromVolume.position;
    }

    tests::ScriptedExploration world_;
    std::optional<ExportJob> exporting_;
    std::unique_ptr<Headset> headset_;
};

class FrontEndWithHands : public FrontEnd {
 protected:
    void SetUp() override {
        devices_.head().centre = tests::place({0, 1.6, 0});
        for (int h = 0; h < 2; ++h)
            devices_.hand(h).place = tests::place({h == 0 ? -0.3 : 0.3, 1.1, -0.4});
        devices_.send();
        open();
        framesUntil([&] { return headset_->interaction().panel().has_value() && volume().y > 1; });
    }
    void TearDown() override { headset_.reset(); }  // before its runtime goes

    tests::MonadoService service_{tests::Monado::Remote};
    tests::RemoteDevices devices_{service_.remotePort()};
};

}  // namespace app::headset
