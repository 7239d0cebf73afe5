#include "render/splat/solid_tets.h"

#include <cmath>

namespace render {

unsigned SolidTets::take(const std::array<std::uint32_t, 4>& points, Tetrahedron& tet) const {
    unsigned seen = 0, there = 0;
    double sum = 0;
    for (unsigned i = 0; i < 4; ++i) {
        tet.at[i] = placed_.alongAxes(points[i]);
        if (i > 0 && comesRound_)
            tet.at[i] = tet.at[0] + timeseries::shorterWay(tet.at[i] - tet.at[0], period_);
        if (!timeseries::isPlace(tet.at[i])) return 0;
        tet.corners[i] = points[i];
        tet.values[i] = timeseries::finiteValue(field_, points[i]);
        if (std::isnan(tet.values[i])) continue;
        ++there;
        sum += tet.values[i] / 4;  // no sum of four overflows
        if (!clips_ || placed_.inside(points[i], clip_)) seen |= 1u << i;
    }
    for (double& value : tet.values)
        if (std::isnan(value)) value = sum * (4.0 / there);
    return seen;
}

}  // namespace render
