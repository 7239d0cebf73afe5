#include "timeseries/readers/cf/cf_mpas.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "timeseries/readers/cf/cf_values.h"

namespace timeseries {
namespace {

struct MpasKind {
    const char *along, *ownX, *ownY, *x, *y, *about, *counts;
};
constexpr std::array kMpasKinds{
    MpasKind{"nCells", "lonCell", "latCell", "lonVertex", "latVertex", "verticesOnCell",
             "nEdgesOnCell"},
    MpasKind{"nVertices", "lonVertex", "latVertex", "lonCell", "latCell", "cellsOnVertex", ""}};

bool hasDimension(const NcHeader& header, std::string_view name) {
    return std::ranges::find(header.dimensions, name, &NcDimension::name) !=
           header.dimensions.end();
}

std::optional<std::size_t> positionOf(const NcHeader& header, const NcVariable& variable,
                                      std::string_view dimension) {
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        if (header.dimension(variable, i).name == dimension) return i;
    return std::nullopt;
}

}  // namespace

bool isMpas(const NcHeader& header) {
    return hasDimension(header, "nCells") && hasDimension(header, "nVertices") &&
           header.find("verticesOnCell", "") && header.find("lonVertex", "");
}

bool isOnMpas(const NcHeader& header, const NcVariable& variable) {
    if (!isMpas(header)) return false;
    constexpr std::array kAlong{"nCells", "nVertices", "nEdges"};
    return std::ranges::any_of(
        kAlong, [&](const char* name) { return positionOf(header, variable, name).has_value(); });
}

bool isOfMpasMesh(const NcHeader& header, const NcVariable& variable) {
    if (!isOnMpas(header, variable)) return false;
    const std::string_view name = variable.name;
    for (const std::string_view of : {"Cell", "Vertex", "Edge"})
        for (const std::string_view what : {"lon", "lat", "x", "y", "z"})
            if (name.ends_with(of) && name.substr(0, name.size() - of.size()) == what) return true;
    return name.ends_with("OnCell") || name.ends_with("OnVertex") || name.ends_with("OnEdge") ||
           (name.starts_with("indexTo") && name.ends_with("ID"));
}

std::optional<MpasPlaces> mpasPlacesOf(const NcHeader& header, const NcVariable& variable) {
    if (!isMpas(header)) return std::nullopt;
    for (const MpasKind& kind : kMpasKinds) {
        const auto list = positionOf(header, variable, kind.along);
        const NcVariable *const x = header.find(kind.x, ""), *const y = header.find(kind.y, ""),
                                *const about = header.find(kind.about, "");
        if (!list || !x || !y || !about || x->dimensions.size() != 1 || !x->type ||
            !y->isAlong(x->dimensions[0]) || !about->type || about->dimensions.size() != 2 ||
            about->dimensions[0] != variable.dimensions[*list])
            continue;
        std::optional<std::size_t> levels;
        for (std::size_t i = 0; i < variable.dimensions.size(); ++i) {
            const NcDimension& each = header.dimension(variable, i);
            const bool isLevels =
                each.name.starts_with("nVertLevels") || each.name.starts_with("nSoilLevels");
            if (isLevels && each.length > 1) levels = i;
        }
        const NcVariable* const counts = header.find(kind.counts, "");
        const bool isCounted = counts && counts->isAlong(about->dimensions[0]);
        return MpasPlaces{{.x = x->name,
                           .y = y->name,
                           .by = ColumnPlaces::By::Faces,
                           .faces = about->name,
                           .faceSizes = isCounted ? counts->name : "",
                           .firstNode = 1,
                           .units = x->text("units").empty() ? "radian" : x->text("units"),
                           .xName = kind.ownX,
                           .yName = kind.ownY},
                          *list,
                          levels};
    }
    return std::nullopt;
}

std::optional<Axis> mpasDepthsOf(const CfFile& file, const NcVariable& variable,
                                 std::size_t position) {
    const NcHeader& header = file.header();
    constexpr std::string_view kLevels = "nVertLevels", kBetween = "nVertLevelsP1";
    const NcDimension& levels = header.dimension(variable, position);
    const bool between = levels.name == kBetween;
    if ((levels.name != kLevels && !between) || !isOnMpas(header, variable)) return std::nullopt;
    const auto ofEach = [&](const char* name) -> const NcVariable* {
        const NcVariable* const found = header.find(name, "");
        const bool isIt = found && found->type && found->dimensions.size() == 1 &&
                          header.dimension(*found, 0).name == kLevels &&
                          header.dimension(*found, 0).length + (between ? 1 : 0) == levels.length;
        return isIt ? found : nullptr;
    };
    const auto unitsOf = [](const NcVariable& depth) {
        return depth.text("units").empty() ? std::string("m") : depth.text("units");
    };
    if (const NcVariable* const bottoms = ofEach("refBottomDepth")) {
        std::vector<double> depths = valuesOf(file, *bottoms);
        depths.insert(depths.begin(), 0);
        if (!between) {
            for (std::size_t k = 0; k + 1 < depths.size(); ++k)
                depths[k] = 0.5 * (depths[k] + depths[k + 1]);
            depths.pop_back();
        }
        return Axis{"depth", unitsOf(*bottoms), std::move(depths), true};
    }
    const NcVariable* const middles = between ? nullptr : ofEach("refZMid");
    if (!middles) return std::nullopt;
    return Axis{middles->name, unitsOf(*middles), valuesOf(file, *middles), false};
}

}  // namespace timeseries
