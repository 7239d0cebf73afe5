// What a hexahedron with bent faces takes: an oracle by quadrature.
#pragma once

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace tests {

// Of eight corners as VTK numbers those of a hexahedron. The determinant of the slopes is of the
// second degree along each coordinate, of which Gauss's two points miss nothing.
inline double trilinearVolume(std::span<const glm::dvec3> corners) {
    const auto at = [&](const glm::dvec3& u) {
        glm::dvec3 sum(0);
        for (std::size_t k = 0; k < 8; ++k) {
            const glm::bvec3 far((k & 3) == 1 || (k & 3) == 2, (k & 3) > 1, k > 3);
            double share = 1;
            for (int a = 0; a < 3; ++a) share *= far[a] ? u[a] : 1 - u[a];
            sum += share * corners[k];
        }
        return sum;
    };
    const double away = std::sqrt(1.0 / 3) / 2;
    double volume = 0;
    for (unsigned point = 0; point < 8; ++point) {
        glm::dvec3 u;
        for (int a = 0; a < 3; ++a) u[a] = 0.5 + (point >> a & 1 ? away : -away);
        // Differences of a function that is linear along each coordinate are its slopes.
        glm::dmat3 slopes;
        for (int a = 0; a < 3; ++a) {
            glm::dvec3 more = u, less = u;
            more[a] = 1, less[a] = 0;
            slopes[a] = at(more) - at(less);
        }
        volume += glm::determinant(slopes) / 8;
    }
    return volume;
}

}  // namespace tests
