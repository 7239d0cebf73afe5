// Where labels stand in a picture: inside it, apart from each other and from what was there before
// them, and on no line. Pure.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/annotate/box_edges.h"
#include "render/annotate/flat_mesh.h"

namespace render {

// The part of a to b inside a rectangle, as fractions; none where they only touch.
std::optional<glm::dvec2> partInside(const glm::dvec2& a, const glm::dvec2& b,
                                     const PixelRect& rect);
// What is left of a line where texts stand: pieces outside all rectangles, as fractions, ascending.
std::vector<glm::dvec2> piecesOutside(const glm::dvec2& a, const glm::dvec2& b,
                                      std::span<const PixelRect> rects);
// How far a rectangle is from a line; 0 where they meet. REQUIRES: it has an area.
double distance(const PixelRect& rect, const glm::dvec2& a, const glm::dvec2& b);

// The box as one eye sees it, as the middle does, and as the other eye does, which sees every place
// as far to the other side of the middle. What stands well in all of them stands well for both eyes
// and at the same place of the box: so both have the same labels. Without a second eye the three
// are one.
class Sights {
 public:
    Sights(const View& view, const Middle& middle, const glm::dvec3& boxHalf);

    const Screen& eye() const { return eye_; }
    const Screen& middle() const { return middle_; }
    std::size_t count() const { return count_; }
    // REQUIRES: before both near planes.
    glm::dvec2 pixel(std::size_t sight, const glm::dvec3& at) const;
    bool visible(const glm::dvec3& at) const;

 private:
    Screen eye_, middle_;
    std::size_t count_;
};

// A text that goes with a place of the box.
struct Label {
    std::string text;
    glm::dvec3 anchor{0};   // axis coordinates
    PixelRect ink;          // from where the anchor is seen
    glm::dvec2 topLeft{0};  // of the text, likewise
};

class LabelPlaces {
 public:
    LabelPlaces(const Sights& sights, glm::dvec2 size, std::span<const PixelRect> taken);

    // Nothing may stand there from now on.
    void takeLine(const glm::dvec3& from, const glm::dvec3& to);
    void takeTick(const glm::dvec3& at, const glm::dvec2& to);  // `to`: from where it is seen
    void take(const Label& label);
    // So far from the picture's edges, and so far apart from what is taken.
    bool fits(const Label& label, double margin, double apart) const;
    // Whether two labels are so far apart for every eye.
    bool apart(const Label& a, const Label& b, double by) const;

 private:
    struct Line {
        glm::dvec2 from, to;
    };
    const Sights& sights_;
    glm::dvec2 size_;
    std::vector<std::vector<PixelRect>> rects_;  // [sight]
    std::vector<std::vector<Line>> lines_;       // [sight]
};

}  // namespace render
