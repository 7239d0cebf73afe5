#include "timeseries/readers/vtk/vtk_variables.h"

#include <fmt/format.h>

#include <algorithm>

namespace timeseries {
namespace {

constexpr std::size_t kMaxVtkVariables = std::size_t{1} << 16;

}  // namespace

std::vector<VtkVariable> vtkVariablesOf(const std::filesystem::path& path,
                                        std::span<const VtkArray> arrays) {
    std::vector<VtkVariable> all;
    for (const VtkArray& array : arrays) {
        const bool both = std::ranges::any_of(arrays, [&](const VtkArray& o) {
            return o.name == array.name && o.place != array.place;
        });
        std::string name = array.name;
        if (both) name += array.place == VtkPlace::Points ? " (points)" : " (cells)";
        const std::string type(typeName(array.type));
        const std::string where = array.place == VtkPlace::Points ? "" : ", at cells";
        if (array.components == 1) {
            all.push_back({std::move(name), array.type, type + where, array, {}});
            continue;
        }
        if (all.size() + array.components > kMaxVtkVariables)
            failVtk(path, fmt::format("'{}'", array.name),
                    fmt::format("expected at most {} components of all arrays", kMaxVtkVariables));
        const std::string stored =
            fmt::format("{}, {} components{}", type, array.components, where);
        if (array.components <= 3) {
            const bool single = array.type == ValueType::F32;
            all.push_back(
                {name + " magnitude",
                 single ? ValueType::F32 : ValueType::F64,
                 fmt::format("{}; magnitude in {}", stored, single ? "float32" : "float64"),
                 array,
                 {VtkPart::Kind::Magnitude, 0}});
        }
        for (std::size_t i = 0; i < array.components; ++i)
            all.push_back({fmt::format("{}[{}]", name, i),
                           array.type,
                           stored,
                           array,
                           {VtkPart::Kind::Component, i}});
    }
    return all;
}

}  // namespace timeseries
