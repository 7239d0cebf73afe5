#include "app/drawing/picture_error.h"

#include <atomic>
#include <exception>
#include <new>
#include <system_error>
#include <thread>

namespace app {

// Its thread writes `errors` and lets go of the step before it is done.
struct PictureError::Work {
    Picture picture;
    std::weak_ptr<const timeseries::SortedStep> sorted;
    DepthErrors errors;
    std::atomic<bool> wanted = true, done = false;

    bool isOf(const Picture& other) const {
        return sorted.lock() == other.sorted && picture.explorer == other.explorer &&
               picture.view == other.view && picture.parts == other.parts;
    }
    void run() {
        try {
            // One thread: the interface has the others.
            errors = depthErrorsOf(picture.explorer, *picture.sorted, picture.view,
                                   rungsOf(picture.explorer, *picture.sorted), {picture.parts, 1},
                                   wanted);
        } catch (const std::bad_alloc&) {
            errors.whyNone = "there is not enough memory to work it out";
        } catch (const std::exception& error) {
            errors.whyNone = error.what();
        }
        picture.sorted.reset();
        done = true;
    }
};

void PictureError::forget() {
    if (work_) work_->wanted = false;
}

std::optional<DepthErrors> PictureError::of(const Picture& picture) {
    if (work_ && !work_->done) return std::nullopt;
    if (work_ && work_->wanted && work_->isOf(picture)) return work_->errors;
    auto work = std::make_shared<Work>();
    work->picture = picture;
    work->sorted = picture.sorted;
    try {
        std::thread([work] { work->run(); }).detach();
    } catch (const std::system_error&) {
        DepthErrors none;
        none.whyNone = "there is no thread to work it out";
        return none;
    }
    work_ = std::move(work);
    return std::nullopt;
}

PictureError::~PictureError() { forget(); }

}  // namespace app
