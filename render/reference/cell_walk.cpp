#include "render/reference/cell_walk.h"

namespace render {

CellWalk::CellWalk(const PlacedPoints& placed)
    : CellWalk(placed, 0, std::size_t{placed.size().z} + 1) {}

CellWalk::CellWalk(const PlacedPoints& placed, std::size_t first, std::size_t end)
    : size_(placed.size() + 1u), box_{{0, 0, first}, {size_.x, size_.y, end}} {
    for (std::size_t a = 0; a < 3; ++a) {
        const auto &at = placed.positions()[a], &width = placed.widths()[a];
        const double half = at.front() > at.back() ? -0.5 : 0.5;
        faces_[a].reserve(at.size() + 2);
        faces_[a].push_back(at.front() - half * width.front());
        faces_[a].insert(faces_[a].end(), at.begin(), at.end());
        faces_[a].push_back(at.back() + half * width.back());
    }
}

CellWalk CellWalk::inBricks(unsigned cells) const {
    CellWalk bricks;
    bricks.size_ = (size_ + cells - 1u) / cells;
    bricks.box_.end = bricks.size_;
    for (int a = 0; a < 3; ++a)
        for (unsigned i = 0; i <= bricks.size_[a]; ++i)
            bricks.faces_[static_cast<std::size_t>(a)].push_back(
                face(a, std::min(i * cells, size_[a])));
    return bricks;
}

std::size_t CellWalk::cellAt(int axis, double place, const Box& box) const {
    const std::vector<double>& faces = faces_[static_cast<std::size_t>(axis)];
    const bool down = faces.front() > faces.back();
    const auto isPassed = [&](double face) { return down ? face >= place : face <= place; };
    const auto passed = std::ranges::partition_point(faces, isPassed) - faces.begin();
    return static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(passed - 1, box.first[axis], std::ptrdiff_t{box.end[axis]} - 1));
}

}  // namespace render
