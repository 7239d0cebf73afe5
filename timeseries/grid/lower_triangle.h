// Lower triangular matrices of three rows: the shape of a cell without the sense of its sides, for
// L L^T = J J^T says how far the cell of the steps J reaches each way, and |det L| = |det J|.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace timeseries {

template <typename Real>
struct LowerTriangle {
    using Vec3 = glm::vec<3, Real>;
    Vec3 diagonal{0};
    Vec3 below{0};  // of the first column in the second row; of both in the third
    Real determinant() const { return diagonal.x * diagonal.y * diagonal.z; }
    // Rows, from the first on.
    std::array<Vec3, 3> rows() const {
        return {Vec3(diagonal.x, 0, 0), Vec3(below.x, diagonal.y, 0),
                Vec3(below.y, below.z, diagonal.z)};
    }
    // Each row times a number: of coordinates in other units.
    LowerTriangle scaled(const Vec3& by) const {
        return {by * diagonal, Vec3(by.y, by.z, by.z) * below};
    }
    // Solves L x = v.
    Vec3 solve(const Vec3& v) const {
        Vec3 x;
        x.x = v.x / diagonal.x;
        x.y = (v.y - below.x * x.x) / diagonal.y;
        x.z = (v.z - below.y * x.x - below.z * x.y) / diagonal.z;
        return x;
    }
    template <typename Other>
    LowerTriangle<Other> as() const {
        return {glm::vec<3, Other>(diagonal), glm::vec<3, Other>(below)};
    }
};

// L with L L^T = M M^T, by orthogonal rows. REQUIRES: M is not singular.
inline LowerTriangle<double> factorOf(std::array<glm::dvec3, 3> rows) {
    LowerTriangle<double> out;
    for (int r = 0; r < 3; ++r) {
        for (int before = 0; before < r; ++before) {
            const double along = glm::dot(rows[r], rows[before]);
            rows[r] -= along * rows[before];
            out.below[before + r - 1] = along;
        }
        out.diagonal[r] = glm::length(rows[r]);
        rows[r] /= out.diagonal[r];
    }
    return out;
}

// L with L L^T = M M^T + grown I, by orthogonal rows instead of squares: those of M and of
// sqrt(grown) I beside it. Its diagonal is `least` or more.
inline LowerTriangle<double> factorOf(const std::array<glm::dvec3, 3>& rowsOfM, double grown,
                                      double least) {
    struct Row {
        glm::dvec3 of{0}, beside{0};
    };
    const auto dot = [](const Row& a, const Row& b) {
        return glm::dot(a.of, b.of) + glm::dot(a.beside, b.beside);
    };
    std::array<Row, 3> rows;
    LowerTriangle<double> out;
    for (int r = 0; r < 3; ++r) {
        Row& row = rows[r];
        row.of = rowsOfM[r];
        row.beside[r] = std::sqrt(grown);
        for (int before = 0; before < r; ++before) {
            const double along = dot(row, rows[before]);
            row.of -= along * rows[before].of;
            row.beside -= along * rows[before].beside;
            out.below[before + r - 1] = along;
        }
        out.diagonal[r] = std::max(std::sqrt(dot(row, row)), least);
        row.of /= out.diagonal[r];
        row.beside /= out.diagonal[r];
    }
    return out;
}

}  // namespace timeseries
