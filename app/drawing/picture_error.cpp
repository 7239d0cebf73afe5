#include "app/drawing/picture_error.h"

#include <atomic>
#include <limits>
#include <system_error>
#include <thread>

#include "app/picture/depth_error.h"

namespace app {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

// Its thread writes `error` and lets go of the step before it is done.
struct PictureError::Work {
    Picture picture;
    std::weak_ptr<const timeseries::SortedStep> sorted;
    double error = kUnknown;
    std::atomic<bool> wanted = true, done = false;

    bool isOf(const Picture& other) const {
        return sorted.lock() == other.sorted && picture.explorer == other.explorer &&
               picture.view == other.view;
    }
    void run() {
        try {
            // One thread: the interface has the others.
            error = depthErrorOf(picture.explorer, *picture.sorted, picture.view, 1, wanted);
        } catch (...) {  // then it is not told: a picture is as good without
        }
        picture.sorted.reset();
        done = true;
    }
};

void PictureError::forget() {
    if (work_) work_->wanted = false;
}

std::optional<double> PictureError::of(const Picture& picture) {
    if (work_ && !work_->done) return std::nullopt;
    if (work_ && work_->wanted && work_->isOf(picture)) return work_->error;
    auto work = std::make_shared<Work>();
    work->picture = picture;
    work->sorted = picture.sorted;
    try {
        std::thread([work] { work->run(); }).detach();
    } catch (const std::system_error&) {  // no thread to be had
        return kUnknown;
    }
    work_ = std::move(work);
    return std::nullopt;
}

PictureError::~PictureError() { forget(); }

}  // namespace app
