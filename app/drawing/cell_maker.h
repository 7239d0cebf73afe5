// Makes steps' cells where they are wanted, and the gradients by which light falls on those of a
// mesh.
#pragma once

#include <atomic>
#include <memory>

#include "app/drawing/screen.h"

namespace app {

// Few at once, many on a thread of its own, a step after another, which nobody waits for. A step
// for whose cells there is no memory, or whose cells would all take more than steps may have of it,
// is drawn by points from then on. One whose gradients cannot be made is not asked again: its
// tetrahedra keep their own light.
class CellMaker {
 public:
    void want(const Screen& screen);
    bool gaveUp(const timeseries::SortedStep& step) const { return shared_->failed == &step; }

 private:
    // What the thread sees of it.
    struct Shared {
        std::atomic<bool> busy = false;
        std::atomic<const timeseries::SortedStep*> wanted = nullptr, failed = nullptr;
        // Of which all those are there for which there is memory.
        std::atomic<const timeseries::SortedStep*> noMore = nullptr;
    };
    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
};

}  // namespace app
