#include "timeseries/grid/step_grids.h"

#include <algorithm>

#include "timeseries/grid/mesh.h"
#include "timeseries/grid/solid_cells.h"

namespace timeseries {

StepGrids::Are heldAgainst(const Grid& first, const Grid& other) {
    using Are = StepGrids::Are;
    if (first == other) return Are::One;
    const auto &a = first.mesh(), &b = other.mesh();
    if (!a || !b || a->size() != b->size() || a->hasNeighbours() != b->hasNeighbours())
        return Are::Own;
    if (a->hasNeighbours()) return Are::Moved;
    using Points = MeshAbout::Points;
    const MeshAbout &ofA = a->about(), &ofB = b->about();
    const bool areAlone = ofA.points == Points::Scattered || ofA.points == Points::Particles;
    if (areAlone || ofA.points != ofB.points || ofA.cells != ofB.cells || ofA.levels != ofB.levels)
        return Are::Own;
    const auto &solidsOfA = a->solids(), &solidsOfB = b->solids();
    const bool joinedAlike =
        solidsOfA == solidsOfB || (solidsOfA && solidsOfB && solidsOfA->joinsAs(*solidsOfB));
    return joinedAlike ? Are::Moved : Are::Own;
}

}  // namespace timeseries
