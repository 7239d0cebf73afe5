#include "app/choices/rung.h"

#include <algorithm>

namespace app {

std::vector<Rung> ladder(const LadderOf& of) {
    std::vector<Rung> rungs;
    const auto add = [&](Model model, std::uint32_t stride) {
        rungs.push_back({model, stride});
        if (of.coarse && (model == Model::Cells || of.coarsePoints))
            rungs.push_back({model, stride, kCoarse});
    };
    if (of.cells) add(Model::Cells, 1);
    for (std::uint32_t stride = 1; of.points && stride <= of.mostStride; stride *= 2)
        add(Model::Points, stride);
    return rungs;
}

bool drawsLess(const Rung& a, const Rung& b) {
    if (a.model != b.model) return a.model == Model::Points;
    const auto share = [](const Rung& rung) {
        return 1.0 / (rung.stride * static_cast<double>(rung.across));
    };
    return share(a) < share(b);
}

std::vector<Rung> from(const Rung& most, std::vector<Rung> rungs) {
    if (const auto found = std::ranges::find(rungs, most); found != rungs.end())
        rungs.erase(rungs.begin(), found);
    else
        while (rungs.size() > 1 && drawsLess(most, rungs.front())) rungs.erase(rungs.begin());
    return rungs;
}

}  // namespace app
