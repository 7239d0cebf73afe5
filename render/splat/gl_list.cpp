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
void drawSlices(const Piece& of, const Slices& slices) {
    glVertexAttribI4ui(2, static_cast<GLuint>(of.layer), 0, 0, 1);
    glVertexAttribI4ui(4, of.from, of.last, static_cast<GLuint>(kSubsetPeriod / of.stride), 1);
    glMultiDrawArrays(GL_POINTS, slices.first.data(), slices.count.data(),
                      static_cast<GLsizei>(slices.first.size()));
}

bool drawnAlike(const Piece& a, const Piece& b) {
    return a.layer == b.layer && a.from == b.from && a.last == b.last && a.stride == b.stride;
}

}  // namespace

GlList::GlList(const Scene& scene, const GlStep& step)
    : scene_(scene), step_(step), cubes_(scene.placed.cubes()), pieces_(piecesOfRuns(scene)) {
    for (Piece& piece : pieces_) piece.first = step.placeOf(piece.first);
    if (pieces_.empty()) return;  // there may be no room yet
    points_.attach({0, step.gridIndex(), 1, GL_UNSIGNED_INT, 4});
    points_.attach({3, step.placeInBlock(), 1, GL_UNSIGNED_SHORT, 2});
    if (step.values() != nullptr) points_.attach({1, *step.values(), 1, GL_FLOAT, 4});
}

GlList::GlList(const Scene& scene, const GlStep& step, GlDepthOrder::List list)
    : scene_(scene),
      step_(step),
      cubes_(scene.placed.cubes()),
      pieces_(piecesOfSorted(list.count)),
      sorted_(std::move(list.points)) {
    constexpr GLsizei kStride = sizeof(SortedPoint);
    points_.attach({0, *sorted_, 1, GL_UNSIGNED_INT, kStride, 0});
    points_.attach({1, *sorted_, 1, GL_FLOAT, kStride, 4});
    points_.attach({2, *sorted_, 1, GL_UNSIGNED_INT, kStride, 8});
}

std::span<const Piece> GlList::pieces(Channels channels, std::size_t layer) const {
    const bool alone = channels == Channels::Over || channels == Channels::Count;
    if (alone || sorted_) return pieces_;
    return {std::ranges::lower_bound(pieces_, layer, {}, &Piece::layer),
            std::ranges::upper_bound(pieces_, layer, {}, &Piece::layer)};
}

void GlList::drawSprites(std::span<const Piece> pieces) const {
    glBindVertexArray(points_.id());
    // Where there are no arrays of them.
    glVertexAttrib1f(1, 0);
    glVertexAttribI4ui(3, 0, 0, 0, 1);
    while (!pieces.empty()) {
        Slices slices;
        std::size_t drawn = 0;
        for (; drawn < pieces.size() && drawnAlike(pieces[drawn], pieces[0]); ++drawn)
            slices.add(pieces[drawn]);
        drawSlices(pieces[0], slices);
        pieces = pieces.subspan(drawn);
    }
}

// Pieces begin at multiples of kPiecePoints, hence at what drivers ask of what is bound.
void GlList::drawQuads(std::span<const Piece> pieces, const gl::VertexArray& corners) const {
    glBindVertexArray(corners.id());
    const auto bind = [](GLuint place, const gl::Buffer& buffer, const Piece& piece,
                         std::uint64_t each) {
        const std::uint64_t bytes = (piece.count * each + 3) / 4 * 4;  // whole words
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, place, buffer.id(),
                          static_cast<GLintptr>(piece.first * each),
                          static_cast<GLsizeiptr>(bytes));
    };
    for (const Piece& piece : pieces) {
        if (sorted_) {
            bind(0, *sorted_, piece, sizeof(SortedPoint));
        } else {
            bind(0, step_.gridIndex(), piece, sizeof(std::uint32_t));
            if (step_.values() != nullptr) bind(1, *step_.values(), piece, sizeof(float));
            bind(2, step_.placeInBlock(), piece, sizeof(std::uint16_t));
        }
        glUniform4ui(0, piece.from, piece.last, static_cast<GLuint>(kSubsetPeriod / piece.stride),
                     static_cast<GLuint>(piece.layer));
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * piece.count), GL_UNSIGNED_SHORT,
                       nullptr);
    }
}

}  // namespace render
