#include "timeseries/readers/foam/foam_field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "timeseries/readers/foam/foam_file.h"
#include "timeseries/readers/text/number_text.h"

namespace timeseries {
namespace {

struct FoamClass {
    std::string_view field, list;
    std::uint64_t components;
};
constexpr std::array kFoamClasses{FoamClass{"ScalarField", "List<scalar>", 1},
                                  FoamClass{"VectorField", "List<vector>", 3},
                                  FoamClass{"SphericalTensorField", "List<sphericalTensor>", 1},
                                  FoamClass{"SymmTensorField", "List<symmTensor>", 6},
                                  FoamClass{"TensorField", "List<tensor>", 9}};

// Of "volScalarField", also without boundaries: "volScalarField::Internal". Null for others.
const FoamClass* foamClassOf(std::string_view name) {
    constexpr std::string_view kInternal = "::Internal";
    if (name.ends_with(kInternal)) name.remove_suffix(kInternal.size());
    for (const std::string_view place : {"vol", "point"})
        for (const FoamClass& each : kFoamClasses)
            if (name == fmt::format("{}{}", place, each.field)) return &each;
    return nullptr;
}

bool isValues(std::string_view keyword) { return keyword == "internalField" || keyword == "value"; }

// The keyword of the next entry: behind it the file stands. "" at the end.
std::string nextEntry(FoamFile& file) {
    for (;;) {
        std::string keyword(file.next());
        if (!keyword.starts_with('#')) return keyword;
        // "#include "initialConditions"", whose entries are none of this file's.
        file.next();
    }
}

std::vector<std::string> dimensionsIn(FoamFile& file) {
    std::vector<std::string> dimensions;
    file.expect("[");
    while (!file.take("]")) {
        dimensions.emplace_back(file.next());
        if (dimensions.back().empty() || dimensions.size() > 16)
            file.fail("expected dimensions between brackets");
    }
    return dimensions;
}

// Passes entries up to the values inside, behind whose keyword the file then stands.
void findValues(FoamFile& file) {
    for (std::string keyword = nextEntry(file); !isValues(keyword); keyword = nextEntry(file)) {
        if (keyword.empty()) file.fail("expected the entry internalField");
        if (keyword != ";") file.skipEntry();
    }
}

template <typename T>
std::vector<T> rowsInside(FoamFile& file, const FoamClass& of, std::uint64_t count) {
    const std::string how(file.next());
    if (how.starts_with('$') || how.starts_with('#'))
        file.fail(fmt::format("expected values, found {}: macros are not read", how));
    if (how == "nonuniform") {
        file.take(of.list);
        return file.rows<T>(of.components, count, count);
    }
    if (how != "uniform")
        file.fail(fmt::format("expected uniform or nonuniform values, found '{}'", how));
    std::vector<T> one(of.components), rows(count * of.components);
    file.row(of.components, one.data());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = one[i % one.size()];
    return rows;
}

// Exponents of the seven base units.
std::string unitsOf(std::span<const double> exponents) {
    constexpr std::array<std::string_view, 7> kUnits{"kg", "m", "s", "K", "mol", "A", "cd"};
    std::string above, below;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
        const double size = std::abs(exponents[i]);
        if (size == 0) continue;
        const std::string unit =
            size == 1 ? std::string(kUnits[i]) : fmt::format("{}^{:g}", kUnits[i], size);
        if (exponents[i] > 0)
            above += (above.empty() ? "" : " ") + unit;
        else
            below += "/" + unit;
    }
    if (above == "kg" && below == "/m/s^2") return "Pa";
    return (above.empty() && !below.empty() ? "1" : above) + below;
}

}  // namespace

std::string foamUnitsOf(const std::vector<std::string>& dimensions) {
    std::vector<double> exponents;
    for (const std::string& word : dimensions)
        if (const auto number = numberOfText<double>(word)) exponents.push_back(*number);
    if (exponents.size() != dimensions.size()) return fmt::format("{}", fmt::join(dimensions, " "));
    exponents.resize(std::min<std::size_t>(exponents.size(), 7));
    return unitsOf(exponents);
}

FoamFieldHead foamFieldHeadOf(const std::filesystem::path& path) {
    FoamFile file(path);
    const FoamHeader& header = file.header();
    FoamFieldHead head;
    head.className = header.className;
    head.type = header.scalarBytes == 4 ? ValueType::F32 : ValueType::F64;
    const FoamClass* const of = foamClassOf(header.className);
    if (!of) return head;
    head.components = of->components;
    head.atPoints = header.className.starts_with("point");
    for (std::string keyword = nextEntry(file); !keyword.empty(); keyword = nextEntry(file)) {
        if (keyword == "dimensions") {
            head.units = foamUnitsOf(dimensionsIn(file));
            break;
        }
        // Behind binary values nothing is looked for.
        if (isValues(keyword) && header.isBinary) break;
        if (keyword != ";") file.skipEntry();
    }
    return head;
}

void appendFoamValues(const std::filesystem::path& path, const FoamFieldHead& head,
                      std::uint64_t count, Values& out) {
    FoamFile file(path);
    const FoamHeader& header = file.header();
    if (header.className != head.className)
        file.fail(fmt::format("expected a {} as at other times, found a {}", head.className,
                              header.className));
    if (head.type == ValueType::F32 && header.scalarBytes == 8 &&
        (header.isBinary || header.hasArch))
        file.fail("expected scalars of 32 bits as at other times, found 64");
    findValues(file);
    const auto append = [&]<typename T>(std::vector<T>& values) {
        std::vector<T> rows = rowsInside<T>(file, *foamClassOf(head.className), count);
        if (values.empty())
            values = std::move(rows);
        else
            values.insert(values.end(), rows.begin(), rows.end());
    };
    if (head.type == ValueType::F32)
        append(std::get<std::vector<float>>(out));
    else
        append(std::get<std::vector<double>>(out));
}

}  // namespace timeseries
