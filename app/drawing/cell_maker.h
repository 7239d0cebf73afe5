// Makes steps' cells where they are wanted, and the gradients by which light falls on those of a
// mesh.
#pragma once

#include <atomic>
#include <memory>

#include "app/drawing/screen.h"

namespace app {

// Few cells at once, many on a thread of its own, a step after another, which nobody waits for.
class CellMaker {
 public:
    void want(const Screen& screen);

 private:
    std::shared_ptr<std::atomic<bool>> busy_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace app
