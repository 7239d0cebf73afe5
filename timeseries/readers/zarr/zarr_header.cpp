#include "timeseries/readers/zarr/zarr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "timeseries/readers/zarr/zarr_attributes.h"

namespace timeseries {
namespace {

constexpr std::uint64_t kMaxChannels = 256;   // a variable each
constexpr std::size_t kMaxVariables = 16384;  // each is looked for among the others

std::string groupOf(const std::string& name) {
    const auto slash = name.rfind('/');
    return slash == name.npos ? "" : name.substr(0, slash);
}

// As a word of an attribute `coordinates`.
std::string asWord(std::string name) {
    std::ranges::replace(name, ' ', '_');
    return name;
}

class ZarrHeaderBuilder {
 public:
    explicit ZarrHeaderBuilder(const ZarrHierarchy& hierarchy) : hierarchy_(hierarchy) {
        result_.header.format = hierarchy.format;
        result_.damaged = hierarchy.damaged;
        takeLevels();
        takeNamed();
        // Those around others first: these share their dimensions.
        std::vector<const ZarrArray*> arrays;
        for (const ZarrArray& array : hierarchy.arrays)
            if (isWanted(array)) arrays.push_back(&array);
        std::ranges::stable_sort(arrays, {}, [](const ZarrArray* array) {
            return std::ranges::count(array->name, '/');
        });
        for (const ZarrArray* array : arrays) addArray(*array);
        if (!hierarchy.only.empty())
            std::erase_if(result_.damaged,
                          [&](const DamagedVariable& each) { return each.name != hierarchy.only; });
    }
    ZarrHeader take() { return std::move(result_); }

 private:
    void takeLevels();
    void takeNamed();
    bool isWanted(const ZarrArray& array) const;
    void addArray(const ZarrArray& array);
    void addLevel(const ZarrArray& array, const ZarrLevel& level, NcVariable variable);
    void addCoordinate(const ZarrAxis& axis, std::size_t dimension, NcVariable& variable);
    void addChannels(const ZarrArray& array, const ZarrLevel& level, std::size_t position,
                     const NcVariable& variable);
    void add(NcVariable variable, ZarrSource source);
    std::vector<std::string> namesOf(const ZarrArray& array) const;
    std::size_t dimensionOf(const std::string& group, const std::string& name, std::uint64_t length,
                            bool isShared);

    const ZarrHierarchy& hierarchy_;
    std::map<std::string, ZarrLevel> levels_;  // by the array's name
    std::set<std::string> named_;              // by the attribute `coordinates` of hierarchy_.only
    std::map<std::tuple<std::string, std::string, std::uint64_t>, std::size_t> dimensions_;
    ZarrHeader result_;
};

void ZarrHeaderBuilder::takeLevels() {
    for (const ZarrGroup& group : hierarchy_.groups) {
        try {
            for (ZarrLevel& level : zarrLevelsOf(hierarchy_, group))
                levels_.emplace(level.array, std::move(level));
        } catch (const std::invalid_argument& flaw) {
            result_.damaged.push_back(
                {group.name.empty() ? "multiscales" : group.name,
                 fmt::format("{}: {}", hierarchy_.store->told(group.name), flaw.what())});
        }
    }
}

// What may place the values of the array that was named.
void ZarrHeaderBuilder::takeNamed() {
    for (const ZarrArray& array : hierarchy_.arrays)
        if (array.name == hierarchy_.only)
            for (const std::string& word :
                 words(jsonText(jsonMember(&array.attributes, "coordinates"))))
                named_.insert(word);
}

bool ZarrHeaderBuilder::isWanted(const ZarrArray& array) const {
    return hierarchy_.only.empty() || array.name == hierarchy_.only || array.shape.size() < 2 ||
           named_.contains(array.name);
}

// Arrays of a group share a dimension by its name, with those of the groups around it, too.
std::size_t ZarrHeaderBuilder::dimensionOf(const std::string& group, const std::string& name,
                                           std::uint64_t length, bool isShared) {
    if (isShared)
        for (std::string around = group;; around = groupOf(around)) {
            const auto found = dimensions_.find({around, name, length});
            if (found != dimensions_.end()) return found->second;
            if (around.empty()) break;
        }
    const std::size_t added = result_.header.dimensions.size();
    result_.header.dimensions.push_back({name, length, false});
    if (isShared) dimensions_[{group, name, length}] = added;
    return added;
}

std::vector<std::string> ZarrHeaderBuilder::namesOf(const ZarrArray& array) const {
    const std::size_t rank = array.shape.size();
    std::vector<std::string> names = array.dimensions;
    const bool nameless =
        std::ranges::all_of(names, [](const std::string& name) { return name.empty(); });
    names.resize(rank);
    if (nameless && rank >= 3) {
        constexpr std::array kSpace{"z", "y", "x"};
        for (std::size_t i = 0; i < 3; ++i) names[rank - 3 + i] = kSpace[i];
        // Time is the only one before these that is longer than 1; of several the last.
        for (std::size_t d = rank - 3; d-- > 0;)
            if (array.shape[d] > 1) {
                names[d] = "t";
                break;
            }
    }
    for (std::size_t d = 0; d < rank; ++d)
        if (names[d].empty()) names[d] = fmt::format("dim_{}", d);
    return names;
}

void ZarrHeaderBuilder::add(NcVariable variable, ZarrSource source) {
    variable.id = static_cast<int>(result_.sources.size());
    result_.header.variables.push_back(std::move(variable));
    result_.sources.push_back(source);
}

void ZarrHeaderBuilder::addArray(const ZarrArray& array) {
    NcVariable variable;
    variable.name = array.name;
    variable.group = groupOf(array.name);
    variable.type = array.type;
    variable.filled = false;
    variable.attributes = zarrAttributesOf(array);
    const std::size_t rank = array.shape.size();
    const bool isField = rank >= 2;
    if (isField && !array.flaw.empty()) {
        result_.damaged.push_back(
            {array.name, fmt::format("{}: {}", hierarchy_.store->told(array.folder), array.flaw)});
        variable.type.reset();
    }
    if (const auto level = levels_.find(array.name); level != levels_.end())
        return addLevel(array, level->second, std::move(variable));
    const std::vector<std::string> names = namesOf(array);
    for (std::size_t d = 0; d < rank; ++d)
        variable.dimensions.push_back(
            dimensionOf(variable.group, names[d], array.shape[d], !array.dimensions.empty()));
    // A table, as far as anybody can tell.
    if (rank == 2 && array.dimensions.empty()) variable.type.reset();
    add(std::move(variable), {.array = &array});
}

void ZarrHeaderBuilder::addLevel(const ZarrArray& array, const ZarrLevel& level,
                                 NcVariable variable) {
    std::optional<std::size_t> channels;
    for (std::size_t d = 0; d < level.axes.size(); ++d) {
        const ZarrAxis& axis = level.axes[d];
        if (axis.isChannel && array.shape[d] > 1 && array.shape[d] <= kMaxChannels && !channels) {
            channels = d;
            continue;
        }
        // Times that are but counted are not told, only that they are times.
        const bool isCounted = axis.kind == AxisKind::T &&
                               (!axis.places || (axis.units.empty() && axis.places->scale == 1 &&
                                                 axis.places->offset == 0));
        variable.dimensions.push_back(
            dimensionOf(array.name, isCounted ? "t" : axis.name, array.shape[d], false));
        if (axis.kind && axis.places && !isCounted)
            addCoordinate(axis, variable.dimensions.back(), variable);
    }
    if (level.areLabels)
        variable.attributes.push_back({"flag_meanings", std::string("labels"), std::nullopt});
    if (channels)
        addChannels(array, level, *channels, variable);
    else
        add(std::move(variable), {.array = &array});
}

// Each level has its own, in a group that no array can be in.
void ZarrHeaderBuilder::addCoordinate(const ZarrAxis& axis, std::size_t dimension,
                                      NcVariable& variable) {
    // As the variable names it from its own group; what else it names is of no image.
    const std::string own = asWord(std::string(variable.baseName()));
    const std::string word = own + '/' + asWord(axis.name);
    NcVariable coordinate;
    coordinate.group = variable.group + (variable.group.empty() ? "" : "/") + own;
    coordinate.name = coordinate.group + '/' + asWord(axis.name);
    coordinate.type = ValueType::F64;
    coordinate.dimensions = {dimension};
    coordinate.filled = false;
    const char* const letter = axis.kind == AxisKind::X   ? "X"
                               : axis.kind == AxisKind::Y ? "Y"
                               : axis.kind == AxisKind::Z ? "Z"
                                                          : "T";
    coordinate.attributes = {{"axis", std::string(letter), std::nullopt},
                             {"units", axis.units, std::nullopt}};
    auto said = std::ranges::find(variable.attributes, "coordinates", &NcAttribute::name);
    if (said == variable.attributes.end())
        said = variable.attributes.insert(said, {"coordinates", std::string(), std::nullopt});
    said->value = variable.text("coordinates") + ' ' + word;
    add(std::move(coordinate), {.places = *axis.places});
}

// A variable for each.
void ZarrHeaderBuilder::addChannels(const ZarrArray& array, const ZarrLevel& level,
                                    std::size_t position, const NcVariable& variable) {
    if (result_.header.variables.size() + array.shape[position] > kMaxVariables) {
        result_.damaged.push_back(
            {array.name,
             fmt::format("{}: expected at most {} variables, found more with its {} "
                         "channels",
                         hierarchy_.store->told(""), kMaxVariables, array.shape[position])});
        return;
    }
    std::set<std::string> seen{""};
    for (std::size_t c = 0; c < array.shape[position]; ++c) {
        std::string label = c < level.channels.size() ? level.channels[c] : "";
        if (!seen.insert(label).second) label = fmt::format("channel {}", c);
        NcVariable channel = variable;
        channel.name += ' ' + label;
        add(std::move(channel), {.array = &array, .channels = position, .channel = c});
    }
}

}  // namespace

ZarrHeader zarrHeaderOf(const ZarrHierarchy& hierarchy) {
    return ZarrHeaderBuilder(hierarchy).take();
}

}  // namespace timeseries
