#include "app/drawing/cell_maker.h"

#include <cstdint>
#include <thread>

namespace app {

void CellMaker::want(const Screen& screen) {
    constexpr std::uint64_t kAtOnce = 1 << 18;  // 8 ms
    const auto& step = screen.sorted;
    const render::PlacedPoints& placed = screen.held->placed;
    if (!needsCells(screen.explorer, *step, placed)) return;
    // Null where light does not ask for them.
    const auto mesh = needsGradients(screen.explorer, *step, placed) ? placed.mesh() : nullptr;
    if (step->cellsIfMade() && !(mesh && !step->gradientsIfMade(mesh))) return;
    if (step->grid().count() <= kAtOnce) {
        step->cells();
        if (mesh) step->gradients(mesh);
    } else if (!busy_->exchange(true)) {
        // What is shown first, which takes a tenth of the time; then whatever may be.
        std::thread([step, mesh, needed = cellsNeeded(screen.explorer, step->type()),
                     busy = busy_] {
            try {
                step->cells(needed);
                if (mesh) step->gradients(mesh);
                step->cells();
            } catch (...) {  // for want of memory or threads: points are drawn, as before
            }
            *busy = false;
        }).detach();
    }
}

}  // namespace app
