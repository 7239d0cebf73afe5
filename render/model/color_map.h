// Value -> colour by name. The sequential maps rise evenly in lightness; the diverging one has a
// neutral centre for a value that means "no difference".
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace render {

struct ColorMapTable;

// A value: copies share an immutable table that lives as long as the program.
class ColorMap {
 public:
    ColorMap();  // viridis

    std::string_view name() const;
    // Its colours the other way round, of the same name.
    ColorMap reversed() const;

    // Linear light. t is clamped to [0, 1], NaN is 0. Interpolation between entries is linear in
    // LINEAR light: neighbours are so close that the space does not show, and a GPU texture of the
    // entries, filtered, gives the same colours.
    glm::vec3 at(double t) const;

    // Linear light at evenly spaced t, from 0 to 1; 256 entries, or 257 where the centre is one.
    std::span<const glm::vec3> entries() const;

    bool operator==(const ColorMap&) const = default;

 private:
    friend std::optional<ColorMap> colorMapNamed(std::string_view);
    explicit ColorMap(const ColorMapTable& table) : table_(&table) {}

    const ColorMapTable* table_;
};

// The colours from the first entry to each, added up (trapezoids), so that of places among entries
// the mean colour between two is the difference of their sums over the places'.
std::vector<glm::vec3> sumsOf(std::span<const glm::vec3> entries);

std::span<const std::string_view> colorMapNames();  // the first is the default
std::optional<ColorMap> colorMapNamed(std::string_view);

}  // namespace render
