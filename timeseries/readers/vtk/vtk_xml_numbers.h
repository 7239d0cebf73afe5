// What elements of a VTK XML file say in their attributes: numbers, or the sentence why not.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/readers/text/words.h"
#include "timeseries/readers/vtk/vtk_header.h"
#include "timeseries/readers/vtk/vtk_number.h"
#include "timeseries/readers/vtk/vtk_xml.h"

namespace timeseries {

inline std::vector<const XmlElement*> named(const XmlElement& parent, std::string_view name) {
    std::vector<const XmlElement*> found;
    for (const XmlElement& child : parent.children)
        if (child.name == name) found.push_back(&child);
    return found;
}

inline std::string placeOf(const XmlElement& element) {
    return fmt::format("line {}, {}", element.line, element.name);
}

// So many numbers, separated by blanks; a count where it is one of an integer type.
template <typename T>
std::vector<T> numbersOf(const XmlFile& file, const XmlElement& element, std::string_view attribute,
                         std::size_t count) {
    const std::string_view text = element.attribute(attribute);
    const std::vector<std::string> all = words(text);
    std::vector<T> numbers;
    for (const std::string& word : all)
        if (const auto number = vtkNumber<T>(word)) numbers.push_back(*number);
    if (all.size() == count && numbers.size() == count) return numbers;
    const bool one = count == 1;
    std::string what = one ? "a count" : fmt::format("{} integers of 32 bits", count);
    if (std::floating_point<T>)
        what = one ? "a finite number" : fmt::format("{} finite numbers", count);
    failVtk(file.path, fmt::format("{} {}", placeOf(element), attribute),
            fmt::format("expected {}, found \"{}\"", what, text.substr(0, 100)));
}

inline std::uint64_t countOf(const XmlFile& file, const XmlElement& element,
                             std::string_view attribute, std::uint64_t absent) {
    return element.has(attribute) ? numbersOf<std::uint32_t>(file, element, attribute, 1)[0]
                                  : absent;
}

inline const XmlElement& rootOf(const XmlFile& file) {
    if (file.root.name != "VTKFile")
        failVtk(
            file.path, "",
            fmt::format("expected a VTK file, whose root is VTKFile, found {}", file.root.name));
    return file.root;
}

}  // namespace timeseries
