#include "render/splat/gl_list.h"

#include <algorithm>
#include <utility>

namespace render {
namespace {

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

GlList::GlList(const Scene& scene, const GlStep& step)
    : scene_(scene), step_(step), cubes_(scene.placed.cubes()), pieces_(piecesOfRuns(scene)) {
    for (Piece& piece : pieces_) piece.first = step.placeOf(piece.first);
    if (pieces_.empty()) return;  // there may be no room yet
    for (const GLuint divisor : {0u, 1u}) {
        gl::VertexArray& array = divisor == 0 ? points_ : quads_;
        array.attach({0, step.gridIndex(), 1, GL_UNSIGNED_INT, 4, 0, divisor});
        array.attach({3, step.placeInBlock(), 1, GL_UNSIGNED_SHORT, 2, 0, divisor});
        if (step.values() != nullptr) array.attach({1, *step.values(), 1, GL_FLOAT, 4, 0, divisor});
    }
}

GlList::GlList(const Scene& scene, const GlStep& step, GlDepthOrder::List list)
    : scene_(scene),
      step_(step),
      cubes_(scene.placed.cubes()),
      pieces_(piecesOfSorted(list.count)),
      sorted_(std::move(list.points)) {
    for (const GLuint divisor : {0u, 1u}) {
        gl::VertexArray& array = divisor == 0 ? points_ : quads_;
        constexpr GLsizei kStride = sizeof(SortedPoint);
        array.attach({0, *sorted_, 1, GL_UNSIGNED_INT, kStride, 0, divisor});
        array.attach({1, *sorted_, 1, GL_FLOAT, kStride, 4, divisor});
        array.attach({2, *sorted_, 1, GL_UNSIGNED_INT, kStride, 8, divisor});
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
