#include "app/drawing/cell_maker.h"

#include <cstdint>
#include <thread>

namespace app {

void CellMaker::want(const Screen& screen) {
    constexpr std::uint64_t kAtOnce = 1 << 18;  // 8 ms
    const auto& step = screen.sorted;
    if (!needsCells(screen.explorer, *step, screen.held->placed) || step->cellsIfMade()) return;
    if (step->grid().count() <= kAtOnce) {
        step->cells();
    } else if (!busy_->exchange(true)) {
        // What is shown first, which takes a tenth of the time; then whatever may be.
        std::thread([step, needed = cellsNeeded(screen.explorer, step->type()), busy = busy_] {
            try {
                step->cells(needed);
                step->cells();
            } catch (...) {  // for want of memory or threads: points are drawn, as before
            }
            *busy = false;
        }).detach();
    }
}

}  // namespace app
