#include "app/exploration/globe_maker.h"

#include <atomic>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "app/choices/map_flaw.h"
#include "render/points/globe.h"

namespace app {

// Its thread writes `made` before it is done.
struct GlobeMaker::Work {
    Wish wish;
    Made made;
    std::atomic<bool> wanted = true, done = false;

    void run() {
        try {
            made.mesh = render::globeOf(*wish.grid, wish.stretch).meshOf(*wish.grid, wanted);
        } catch (const std::invalid_argument&) {
            made.whyFlat = kNoVolumeOnGlobe;
        } catch (const std::exception&) {  // no memory, or no threads to share it
            fail();
        }
        done = true;
    }
    void fail() { made.whyFlat = "there is not enough memory for its globe"; }
};

std::optional<GlobeMaker::Made> GlobeMaker::made(const Wish& wish) const {
    if (std::string flaw = globeFlaw(*wish.grid); !flaw.empty())
        return Made{nullptr, std::move(flaw)};
    if (auto mesh = render::globeOf(*wish.grid, wish.stretch).meshIfMade(*wish.grid))
        return Made{std::move(mesh), ""};
    const bool isOfThis = work_ && work_->done && work_->wanted && work_->wish.grid == wish.grid &&
                          work_->wish.stretch == wish.stretch;
    return isOfThis ? std::optional(work_->made) : std::nullopt;
}

bool GlobeMaker::want(const Wish& wish) {
    constexpr std::uint64_t kAtOnce = 1 << 16;  // 8 ms
    if (made(wish)) return false;
    if (work_ && !work_->done) {
        if (work_->wish.stretch != wish.stretch) work_->wanted = false;
        return false;
    }
    work_ = std::make_shared<Work>();
    work_->wish = wish;
    if (wish.grid->count() <= kAtOnce) {
        work_->run();
        return true;
    }
    try {
        std::thread([work = work_, wake = wake_] {
            work->run();
            wake();
        }).detach();
    } catch (const std::system_error&) {  // no thread to be had
        work_->fail();
        work_->done = true;
    }
    return true;
}

void GlobeMaker::forget() {
    if (work_) work_->wanted = false;
    if (work_ && work_->done) work_.reset();
}

}  // namespace app
