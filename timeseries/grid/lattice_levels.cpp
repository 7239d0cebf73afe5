#include "timeseries/grid/lattice_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace timeseries {
namespace {

using Ratio = std::array<std::int64_t, 3>;

std::int64_t floorOfQuotient(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);  // b > 0
}

// How many cells of a level stand along each axis in one of that before it. 0 where it has fewer.
Ratio ratioOf(const LatticeLevel& coarse, const LatticeLevel& fine) {
    Ratio ratio{};
    for (std::size_t a = 0; a < 3; ++a)
        ratio[a] = static_cast<std::int64_t>(fine.domain.size()[a] / coarse.domain.size()[a]);
    return ratio;
}

IndexBox refined(const IndexBox& box, const Ratio& ratio) {
    IndexBox fine;
    for (std::size_t a = 0; a < 3; ++a) {
        fine.first[a] = box.first[a] * ratio[a];
        fine.last[a] = box.last[a] * ratio[a] + ratio[a] - 1;
    }
    return fine;
}

IndexBox coarsened(const IndexBox& box, const Ratio& ratio) {
    IndexBox coarse;
    for (std::size_t a = 0; a < 3; ++a) {
        coarse.first[a] = floorOfQuotient(box.first[a], ratio[a]);
        coarse.last[a] = floorOfQuotient(box.last[a], ratio[a]);
    }
    return coarse;
}

std::string flawOfBoxes(const LatticeLevel& level, std::size_t number) {
    const IndexBoxes tree(level.boxes);
    for (std::size_t i = 0; i < level.boxes.size(); ++i) {
        if (!level.domain.holds(level.boxes[i]))
            return fmt::format("box {} of level {} leaves the domain", i, number);
        std::size_t other = i;
        tree.forEachMeeting(level.boxes[i], [&](std::size_t each) {
            if (each != i) other = each;
            return other == i;
        });
        if (other != i)
            return fmt::format("boxes {} and {} of level {} have cells in common",
                               std::min(i, other), std::max(i, other), number);
    }
    return "";
}

// Cells that boxes without common cells have of another.
std::uint64_t sharedCells(const LatticeLevel& level, const IndexBoxes& tree, const IndexBox& box) {
    std::uint64_t shared = 0;
    tree.forEachMeeting(box, [&](std::size_t each) {
        shared += common(level.boxes[each], box).count();
        return true;
    });
    return shared;
}

std::string flawBetween(const LatticeLevel& coarse, const LatticeLevel& fine, std::size_t number) {
    const Ratio ratio = ratioOf(coarse, fine);
    if (std::ranges::min(ratio) == 0 || refined(coarse.domain, ratio) != fine.domain)
        return fmt::format("the domain of level {} does not refine that of level {}", number,
                           number - 1);
    const IndexBoxes tree(coarse.boxes);
    for (std::size_t i = 0; i < fine.boxes.size(); ++i) {
        const IndexBox box = coarsened(fine.boxes[i], ratio);
        if (refined(box, ratio) != fine.boxes[i])
            return fmt::format("box {} of level {} covers parts of cells of level {}", i, number,
                               number - 1);
        if (sharedCells(coarse, tree, box) != box.count())
            return fmt::format("box {} of level {} lies where level {} has no cells", i, number,
                               number - 1);
    }
    return "";
}

}  // namespace

std::string flawOf(std::span<const LatticeLevel> levels) {
    for (std::size_t l = 0; l < levels.size(); ++l) {
        if (const std::string flaw = flawOfBoxes(levels[l], l); !flaw.empty()) return flaw;
        if (l == 0) continue;
        const std::string flaw = flawBetween(levels[l - 1], levels[l], l);
        if (!flaw.empty()) return flaw;
    }
    return "";
}

std::vector<std::vector<std::vector<bool>>> coveredCells(std::span<const LatticeLevel> levels) {
    std::vector<std::vector<std::vector<bool>>> covered;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        covered.emplace_back(levels[l].boxes.size());
        if (l + 1 == levels.size()) break;
        const IndexBoxes tree(levels[l].boxes);
        const Ratio ratio = ratioOf(levels[l], levels[l + 1]);
        for (const IndexBox& fine : levels[l + 1].boxes) {
            const IndexBox box = coarsened(fine, ratio);
            tree.forEachMeeting(box, [&](std::size_t each) {
                cover(covered[l][each], levels[l].boxes[each], box);
                return true;
            });
        }
    }
    return covered;
}

}  // namespace timeseries
