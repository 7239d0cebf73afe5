#include "timeseries/readers/vtk/vtk_values.h"

#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>

#include <algorithm>
#include <string_view>
#include <type_traits>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/components.h"

namespace timeseries {
namespace {

template <typename T>
void copyComponent(const T* from, std::size_t components, std::size_t component,
                   const StridedLayout& layout, std::vector<T>& to) {
    to.resize(layout.size[0] * layout.size[1] * layout.size[2]);
    const bool asStored = components == 1 && layout.stride[0] == 1 &&
                          layout.stride[1] == layout.size[0] &&
                          layout.stride[2] == layout.size[0] * layout.size[1];
    if (asStored) {
        std::copy_n(from, to.size(), to.begin());
        return;
    }
    auto next = to.begin();
    forEachPlace(layout,
                 [&](std::size_t tuple) { *next++ = from[tuple * components + component]; });
}

// REQUIRES: three components or fewer.
template <typename T, typename Result>
void magnitudes(const T* from, std::size_t components, const StridedLayout& layout,
                std::vector<Result>& to) {
    to.resize(layout.size[0] * layout.size[1] * layout.size[2]);
    auto next = to.begin();
    forEachPlace(layout, [&](std::size_t tuple) {
        const auto at = [&](std::size_t i) {
            return i < components ? static_cast<double>(from[tuple * components + i]) : 0.0;
        };
        *next++ = static_cast<Result>(lengthOf(at(0), at(1), at(2)));
    });
}

// Duplicate and hidden points; duplicate, refined and hidden cells (vtkDataSetAttributes). A level
// above 0 is how files before VTK 6.3 told of duplicates.
unsigned missingBits(VtkPlace place, bool levels) {
    if (levels) return 0xFF;
    return place == VtkPlace::Points
               ? vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT
               : vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL |
                     vtkDataSetAttributes::HIDDENCELL;
}

}  // namespace

void takeVtkGhosts(vtkDataArray& ghosts, VtkPlace place, const StridedLayout& layout,
                   std::vector<bool>& missing) {
    const bool levels = std::string_view(ghosts.GetName()) == "vtkGhostLevels";
    const unsigned bits = missingBits(place, levels);
    missing.reserve(layout.size[0] * layout.size[1] * layout.size[2]);
    bool any = false;
    forEachPlace(layout, [&](std::size_t tuple) {
        const auto flags = static_cast<unsigned>(
            std::clamp(ghosts.GetComponent(static_cast<vtkIdType>(tuple), 0), 0.0, 255.0));
        missing.push_back((flags & bits) != 0);
        any |= missing.back();
    });
    if (!any) missing = {};
}

void takeVtkValues(vtkDataArray& stored, const VtkArray& array, VtkPart part,
                   const StridedLayout& layout, Field& field) {
    withType(array.type, [&]<typename T>(T) {
        const T* from = static_cast<const T*>(stored.GetVoidPointer(0));
        if (part.kind == VtkPart::Kind::Component) {
            copyComponent(from, array.components, part.component, layout,
                          field.values.emplace<std::vector<T>>());
        } else {
            using Result = std::conditional_t<std::is_same_v<T, float>, float, double>;
            magnitudes(from, array.components, layout, field.values.emplace<std::vector<Result>>());
        }
    });
}

}  // namespace timeseries
