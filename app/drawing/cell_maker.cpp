#include "app/drawing/cell_maker.h"

#include <cstdint>
#include <new>
#include <thread>

#include "app/files/memory_budget.h"
#include "timeseries/index/cell_index.h"

namespace app {

using timeseries::CellIndex;

void CellMaker::want(const Screen& screen) {
    constexpr std::uint64_t kCellsAtOnce = 1 << 18;      // 8 ms
    constexpr std::uint64_t kGradientsAtOnce = 1 << 15;  // 8 ms of solids, 2 of others
    const auto& step = screen.sorted;
    const render::PlacedPoints& placed = screen.held->placed;
    shared_->wanted = step.get();
    if (!needsCells(screen.explorer, *step)) return;
    const auto needed = cellsNeeded(screen.explorer, step->type());
    if (!step->cellsIfMade(needed)) {
        const auto [values, cells] = CellIndex::bytesOf(step->grid(), step->type());
        if (values + cells > static_cast<double>(memoryBudget())) return step->giveUpCells();
    }
    const std::uint64_t points = step->grid().count();
    if (points <= kCellsAtOnce) step->cells();
    // Null where they are there, or nothing asks for them.
    auto mesh = needsGradients(screen.explorer, *step, placed) && shared_->failed != step.get() &&
                        !step->gradientsIfMade(placed.mesh())
                    ? placed.mesh()
                    : nullptr;
    if (mesh && points <= kGradientsAtOnce) {
        step->gradients(mesh);
        mesh = nullptr;
    }
    const bool areAllThatFit = step->cellsIfMade(needed) && shared_->noMore == step.get();
    if (((step->cellsIfMade() || areAllThatFit) && !mesh) || shared_->busy.exchange(true)) return;
    // Cells that are shown first, which takes a tenth of the time of all; gradients, unless another
    // step is shown by then; then whatever may be.
    std::thread([step, mesh, needed, areAllThatFit, shared = shared_] {
        try {
            step->cells(needed);
            if (mesh && shared->wanted == step.get()) {
                try {
                    step->gradients(mesh);
                } catch (...) {  // for want of memory
                    shared->failed = step.get();
                }
            }
            if (!areAllThatFit) step->cells();
        } catch (const std::bad_alloc&) {
            if (step->cellsIfMade(needed))
                shared->noMore = step.get();
            else
                step->giveUpCells();
        } catch (...) {  // for want of threads, or its file is gone: points are drawn, as before
        }
        shared->busy = false;
    }).detach();
}

}  // namespace app
