#include "timeseries/readers/vtk/vtk_time.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/vtk/vtk_blocks.h"
#include "timeseries/readers/vtk/vtk_number.h"
#include "timeseries/readers/vtk/vtk_xml_numbers.h"

namespace timeseries {
namespace {

// Blanks around it are part of a name, which VTK keeps.
std::string exactNameOf(const XmlElement& array) {
    for (const auto& [key, value] : array.attributes)
        if (key == "Name") return value;
    return "";
}

// The only value of an array. Nothing where it stands otherwise than is read here.
std::optional<double> valueOf(const XmlFile& file, const XmlElement& array) {
    const VtkType* const type = vtkXmlType(array.attribute("type"));
    if (!type || array.name != "DataArray") return std::nullopt;
    const VtkEncoding encoding = vtkEncodingOf(file);
    const auto stored = readVtkValues(file, encoding, array, placeOf(array), type->bytes);
    const std::string& word = array.firstWord;
    if (!stored && (array.words != 1 || word.empty() || word.size() >= kMaxXmlWord))
        return std::nullopt;
    return withType(type->type, [&]<typename T>(T) -> std::optional<double> {
        if (!stored) {
            const auto number = vtkNumber<T>(word);
            return number ? std::optional(static_cast<double>(*number)) : std::nullopt;
        }
        std::string bytes = *stored;
        if (encoding.bigEndian != (std::endian::native == std::endian::big))
            std::ranges::reverse(bytes);
        T number{};
        std::memcpy(&number, bytes.data(), sizeof number);
        return static_cast<double>(number);
    });
}

}  // namespace

VtkTold vtkTimeOf(const XmlFile& file) {
    const XmlElement& root = rootOf(file);
    VtkTold told;
    auto groups = named(root, "FieldData");  // where files are named
    for (const XmlElement* grid : named(root, root.attribute("type")))
        for (const XmlElement* group : named(*grid, "FieldData")) groups.push_back(group);
    if (groups.size() > 1) return {{}, true};
    std::set<std::string> names;
    for (std::size_t i = 0; !groups.empty() && i < groups[0]->children.size(); ++i) {
        const XmlElement& array = groups[0]->children[i];
        const std::string name = exactNameOf(array);
        const auto isTime = vtkTimeName(name);
        if (!isTime || array.attribute("type") == "String" ||
            countOf(file, array, "NumberOfTuples", 0) *
                    countOf(file, array, "NumberOfComponents", 1) !=
                1)
            continue;
        const auto value = names.insert(name).second ? valueOf(file, array) : std::nullopt;
        if (!value) return {{}, true};
        if (std::isfinite(*value) && (!told.time || *isTime == "time"))
            told.time = VtkTime{*isTime, *value};
    }
    return told;
}

}  // namespace timeseries
