// Where columns of points stand on the Earth whose axes measure something else: degrees about a
// rotated pole, or lengths on a map's projection.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace timeseries {

class EarthPlaces {
 public:
    // [j][i], i fastest: longitude and latitude in degrees. What can be none, as latitudes beyond a
    // pole, is no place, and not finite afterwards; longitudes that lead farther than once round
    // are put from -180 to 180. Throws std::invalid_argument when no column has a place.
    explicit EarthPlaces(std::vector<glm::dvec2> columns);

    // A column is numbered as its point of the first level is.
    const glm::dvec2& operator[](std::uint64_t column) const { return columns_[column]; }
    std::uint64_t count() const { return columns_.size(); }
    // The least and the greatest of each.
    const glm::dvec2& lo() const { return lo_; }
    const glm::dvec2& hi() const { return hi_; }
    friend bool operator==(const EarthPlaces& a, const EarthPlaces& b);

 private:
    void measure();

    std::vector<glm::dvec2> columns_;
    glm::dvec2 lo_, hi_;
};

// A grid of longitudes and latitudes about a pole of its own (CF 1.10, appendix F,
// rotated_latitude_longitude). In degrees.
struct RotatedPole {
    double longitude = 0, latitude = 90;  // of its north pole, on the Earth
    double northPole = 0;                 // longitude of the Earth's north pole, on the grid

    // Longitude, from -180 to 180, and latitude of a place that has these on the grid.
    glm::dvec2 onEarth(const glm::dvec2& onGrid) const;
    friend bool operator==(const RotatedPole&, const RotatedPole&) = default;
};

}  // namespace timeseries
