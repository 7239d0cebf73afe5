#include "timeseries/index/field_slabs.h"

#include <algorithm>
#include <memory>

#include "timeseries/grid/with_type.h"

namespace timeseries {

void forEachSlab(const SortedStep& step, const std::function<bool(const FieldSlab&)>& use,
                 std::size_t bytes) {
    const auto points = step.grid().size();
    const std::size_t cells = points[2] + 1;
    const std::size_t planeBytes =
        points[0] * points[1] * withType(step.type(), [](auto value) { return sizeof(value); });
    const std::size_t atOnce = std::max<std::size_t>(bytes / planeBytes, 1);
    const bool areMany = atOnce < cells && !step.grid().mesh();
    std::shared_ptr<const Field> whole = areMany ? step.fieldIfThere() : step.sharedField();
    if (!areMany) {
        use(*whole);
        return;
    }
    PlanesOf planesOf = whole ? PlanesOf() : step.openPlanes();
    Field planes;
    for (std::size_t first = 0, end; first < cells; first = end) {
        end = std::min(first + atOnce, cells);
        const std::size_t plane = std::max<std::size_t>(first, 1) - 1;
        if (planesOf && !planesOf(plane, std::min(end, points[2]) - plane, planes))
            planesOf = {};  // the source is another by now, and what the step has is not
        if (!planesOf && !whole) whole = step.sharedField();
        if (!use(planesOf ? FieldSlab(planes, points, plane, first, end)
                          : FieldSlab(*whole, points, 0, first, end)))
            return;
    }
}

}  // namespace timeseries
