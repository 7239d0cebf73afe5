#include "timeseries/grid/cell_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace timeseries {
namespace {

glm::dvec3 meanOf(std::span<const glm::dvec3> points) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& point : points) sum += point;
    return points.empty() ? sum : sum / static_cast<double>(points.size());
}

// Adds up simplices that share one corner, from which the others are given.
class Sum {
 public:
    // Of N dimensions and so much volume V: its mean is V s / (N + 1), s the sum of its corners v,
    // and the integral of x x^T is V (sum v v^T + s s^T) / ((N + 1) (N + 2)).
    template <std::size_t N>
    void add(const std::array<glm::dvec3, N>& corners, double volume) {
        glm::dvec3 s(0);
        std::array<double, 6> squares{};
        const auto square = [&](const glm::dvec3& v) {
            squares[0] += v.x * v.x, squares[1] += v.x * v.y, squares[2] += v.x * v.z;
            squares[3] += v.y * v.y, squares[4] += v.y * v.z, squares[5] += v.z * v.z;
        };
        for (const glm::dvec3& corner : corners) {
            s += corner;
            square(corner);
        }
        square(s);
        volume_ += volume;
        first_ += volume / (N + 1) * s;
        for (std::size_t i = 0; i < 6; ++i) second_[i] += volume / ((N + 1) * (N + 2)) * squares[i];
    }
    void add(const Sum& other, double factor) {
        volume_ += factor * other.volume_;
        first_ += factor * other.first_;
        for (std::size_t i = 0; i < 6; ++i) second_[i] += factor * other.second_[i];
    }
    double volume() const { return volume_; }
    CellMoments moments(const glm::dvec3& apex) const {
        if (!(std::abs(volume_) > 0) || !std::isfinite(volume_)) return {0, apex, glm::dmat3(0.0)};
        const glm::dvec3 mean = first_ / volume_;
        const auto& s = second_;
        const glm::dmat3 squares(s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5]);
        return {std::abs(volume_), apex + mean, squares / volume_ - glm::outerProduct(mean, mean)};
    }

 private:
    double volume_ = 0;
    glm::dvec3 first_{0};
    std::array<double, 6> second_{};
};

// What a face and the origin span: to one side positive.
template <typename CornerOf>
Sum spanned(std::size_t corners, const CornerOf& cornerOf) {
    Sum sum;
    const auto tetrahedron = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        sum.add(std::array{a, b, c}, glm::dot(a, glm::cross(b, c)) / 6);
    };
    if (corners == 3) {
        tetrahedron(cornerOf(0), cornerOf(1), cornerOf(2));
        return sum;
    }
    glm::dvec3 middle(0);
    for (std::size_t i = 0; i < corners; ++i) middle += cornerOf(i) / static_cast<double>(corners);
    for (std::size_t i = 0; i < corners; ++i)
        tetrahedron(middle, cornerOf(i), cornerOf((i + 1) % corners));
    return sum;
}

}  // namespace

CellMoments momentsOfPolyhedron(std::span<const std::vector<glm::dvec3>> faces) {
    std::vector<glm::dvec3> middles;
    for (const auto& face : faces) middles.push_back(meanOf(face));
    const glm::dvec3 apex = meanOf(middles);
    Sum sum;
    for (const auto& face : faces) {
        if (face.size() < 3) continue;
        const Sum part = spanned(face.size(), [&](std::size_t i) { return face[i] - apex; });
        sum.add(part, part.volume() < 0 ? -1 : 1);
    }
    return sum.moments(apex);
}

CellMoments momentsOfPolygon(std::span<const glm::dvec3> corners) {
    const glm::dvec3 apex = meanOf(corners);
    // Twice its area along its mean normal: what leans back is subtracted.
    glm::dvec3 normal(0);
    const auto side = [&](std::size_t i) {
        return std::array{corners[i] - apex, corners[(i + 1) % corners.size()] - apex};
    };
    for (std::size_t i = 0; i < corners.size(); ++i) normal += glm::cross(side(i)[0], side(i)[1]);
    if (!(glm::length(normal) > 0)) return {0, apex, glm::dmat3(0.0)};
    normal = glm::normalize(normal);
    Sum sum;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 twice = glm::cross(side(i)[0], side(i)[1]);
        sum.add(side(i), std::copysign(glm::length(twice), glm::dot(twice, normal)) / 2);
    }
    return sum.moments(apex);
}

CellMoments momentsOfLine(std::span<const glm::dvec3> corners) {
    double length = 0;
    glm::dvec3 mean(0);
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const double part = glm::distance(corners[i - 1], corners[i]);
        length += part;
        mean += part / 2 * (corners[i - 1] + corners[i]);
    }
    if (!(length > 0)) return {0, meanOf(corners), glm::dmat3(0.0)};
    mean /= length;
    glm::dmat3 second(0.0);
    for (std::size_t i = 1; i < corners.size(); ++i) {
        // Of a piece about its middle m, and of the whole about that.
        const glm::dvec3 m = (corners[i - 1] + corners[i]) / 2.0 - mean;
        const glm::dvec3 along = corners[i] - corners[i - 1];
        const double share = glm::length(along) / length;
        second += share * (glm::outerProduct(m, m) + glm::outerProduct(along, along) / 12.0);
    }
    return {length, mean, second};
}

}  // namespace timeseries
