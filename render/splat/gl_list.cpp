#include "render/splat/gl_list.h"

#include <algorithm>

namespace render {
namespace {

// One entry of a sorted list as splat.vert reads it.
struct SortedPoint {
    std::uint32_t gridIndex;
    float value;
    std::uint32_t layer;
};

std::vector<SortedPoint> gathered(const Scene& scene, const Sorted& list, const ValueScale& scale) {
    std::vector<SortedPoint> out;
    out.reserve(list.point.size());
    const timeseries::Columns columns = columnsOf(scene);
    for (std::size_t i = 0; i < list.point.size(); ++i) {
        const std::uint32_t p = list.point[i];
        out.push_back({columns.gridIndex[p], scale(valueOf(columns, p)), list.layer[i]});
    }
    return out;
}

// Pieces that lie one behind the other without a gap, sent as one.
struct Slices {
    std::vector<GLint> first;
    std::vector<GLsizei> count;
    void add(const Piece& piece) {
        const auto from = static_cast<GLint>(piece.first);
        const auto points = static_cast<GLsizei>(piece.count);
        if (!first.empty() && first.back() + count.back() == from) {
            count.back() += points;
            return;
        }
        first.push_back(from);
        count.push_back(points);
    }
};

// Attributes without an array have one value for all.
void drawSlices(const Piece& of, const Slices& slices, bool quads) {
    glVertexAttribI4ui(2, static_cast<GLuint>(of.layer), 0, 0, 1);
    glVertexAttribI4ui(4, of.from, of.last, static_cast<GLuint>(kSubsetPeriod / of.stride), 1);
    if (!quads) {
        glMultiDrawArrays(GL_POINTS, slices.first.data(), slices.count.data(),
                          static_cast<GLsizei>(slices.first.size()));
        return;
    }
    for (std::size_t i = 0; i < slices.first.size(); ++i)
        glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, slices.count[i],
                                          static_cast<GLuint>(slices.first[i]));
}

bool drawnAlike(const Piece& a, const Piece& b) {
    return a.layer == b.layer && a.from == b.from && a.last == b.last && a.stride == b.stride;
}

}  // namespace

GlList::GlList(const Scene& scene, const DrawList& list, const GlStep& step,
               const ValueScale& scale)
    : scene_(scene), step_(step), cubes_(scene.placed.cubes()), pieces_(piecesOf(scene, list)) {
    if (const auto* sorted = std::get_if<Sorted>(&list)) {
        const std::vector<SortedPoint> points = gathered(scene, *sorted, scale);
        sorted_.emplace(std::span<const SortedPoint>(points));
    } else {
        for (Piece& piece : pieces_) piece.first = step.placeOf(piece.first);
    }
    for (const GLuint divisor : {0u, 1u}) {
        gl::VertexArray& array = divisor == 0 ? points_ : quads_;
        if (sorted_) {
            constexpr GLsizei kStride = sizeof(SortedPoint);
            array.attach({0, *sorted_, 1, GL_UNSIGNED_INT, kStride, 0, divisor});
            array.attach({1, *sorted_, 1, GL_FLOAT, kStride, 4, divisor});
            array.attach({2, *sorted_, 1, GL_UNSIGNED_INT, kStride, 8, divisor});
        } else if (!pieces_.empty()) {  // else there may be no room yet
            array.attach({0, step.gridIndex(), 1, GL_UNSIGNED_INT, 4, 0, divisor});
            array.attach({3, step.placeInBlock(), 1, GL_UNSIGNED_SHORT, 2, 0, divisor});
            if (step.values() != nullptr)
                array.attach({1, *step.values(), 1, GL_FLOAT, 4, 0, divisor});
        }
    }
}

std::span<const Piece> GlList::pieces(Channels channels, std::size_t layer) const {
    const bool alone = channels == Channels::Over || channels == Channels::Count;
    if (alone || sorted_) return pieces_;
    return {std::ranges::lower_bound(pieces_, layer, {}, &Piece::layer),
            std::ranges::upper_bound(pieces_, layer, {}, &Piece::layer)};
}

void GlList::draw(bool quads, std::span<const Piece> pieces) const {
    glBindVertexArray((quads ? quads_ : points_).id());
    // Where there are no arrays of them.
    glVertexAttrib1f(1, 0);
    glVertexAttribI4ui(3, 0, 0, 0, 1);
    while (!pieces.empty()) {
        Slices slices;
        std::size_t drawn = 0;
        for (; drawn < pieces.size() && drawnAlike(pieces[drawn], pieces[0]); ++drawn)
            slices.add(pieces[drawn]);
        drawSlices(pieces[0], slices, quads);
        pieces = pieces.subspan(drawn);
    }
}

}  // namespace render
