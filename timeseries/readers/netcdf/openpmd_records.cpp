#include "timeseries/readers/netcdf/openpmd_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "timeseries/grid/with_type.h"

namespace timeseries {
namespace {

using Found = std::map<std::pair<std::uint64_t, std::string>, OpenPmdIteration>;

// "data/100/meshes/B/x", cut: of iteration "100" and the rest "meshes/B/x".
struct Cut {
    std::uint64_t number = 0;
    std::string iteration, rest;
};

std::optional<Cut> cutOf(const std::string& name) {
    constexpr std::string_view kBase = "data/";
    if (!name.starts_with(kBase)) return std::nullopt;
    const std::size_t end = std::min(name.find('/', kBase.size()), name.size());
    Cut cut{0, name.substr(kBase.size(), end - kBase.size()),
            end < name.size() ? name.substr(end + 1) : ""};
    const char* const last = cut.iteration.data() + cut.iteration.size();
    const auto [stopped, error] = std::from_chars(cut.iteration.data(), last, cut.number);
    if (cut.iteration.empty() || error != std::errc() || stopped != last) return std::nullopt;
    return cut;
}

// "meshes/" of the attribute meshesPath; "" when there is none.
std::string folderOf(const NcGroup& root, const char* attribute) {
    std::string folder = root.text(attribute);
    while (folder.ends_with('/')) folder.pop_back();
    while (folder.starts_with('/')) folder.erase(0, 1);
    return folder.empty() ? "" : folder + '/';
}

class Records {
 public:
    explicit Records(const NetcdfFile& file) : header_(file.header()) {
        const NcGroup& root = header_.groups.front();
        meshes_ = folderOf(root, "meshesPath");
        particles_ = folderOf(root, "particlesPath");
        for (const NcGroup& group : header_.groups) groups_.emplace(group.name, &group);
        for (const NcVariable& array : header_.variables) add(array.name, &array, array);
        for (const NcGroup& group : header_.groups)
            if (group.find("value") && group.find("shape")) add(group.name, nullptr, group);
    }
    const NcGroup* group(const std::string& name) const {
        const auto at = groups_.find(name);
        return at == groups_.end() ? nullptr : at->second;
    }
    Found found;

 private:
    // A record component of this name in the file; nothing where it stands elsewhere.
    void add(const std::string& name, const NcVariable* array, const NcAttributes& own) {
        const auto cut = cutOf(name);
        if (!cut) return;
        const bool isMesh = !meshes_.empty() && cut->rest.starts_with(meshes_),
                   isParticle = !particles_.empty() && cut->rest.starts_with(particles_);
        if (!isMesh && !isParticle) return;
        std::string rest = cut->rest.substr((isMesh ? meshes_ : particles_).size()), species;
        if (!isMesh) {
            const std::size_t slash = rest.find('/');
            if (slash == rest.npos) return;
            species = rest.substr(0, slash);
            rest = rest.substr(slash + 1);
        }
        const auto parts = std::ranges::count(rest, '/') + 1;
        const NcGroup* const around = group(name.substr(0, name.rfind('/')));
        if (parts > 2 || rest.starts_with("particlePatches/") || (parts == 2 && !around)) return;
        OpenPmdIteration& iteration = found[{cut->number, cut->iteration}];
        iteration.number = cut->number;
        auto& all = isMesh ? iteration.meshes : iteration.species[species];
        const std::string told = isMesh ? rest : species + '/' + rest;
        all.push_back({rest,
                       fmt::format("iteration {}: record component '{}'", cut->iteration, told),
                       array, &own, parts == 2 ? around : &own});
    }

    const NcHeader& header_;
    std::map<std::string, const NcGroup*> groups_;
    std::string meshes_, particles_;
};

// "data/100" says its time in a unit of its own.
std::optional<double> secondsOf(const NetcdfFile& file, const NcGroup* group) {
    if (!group || !group->find("time")) return std::nullopt;
    const auto time = group->numbers("time"), unit = group->numbers("timeUnitSI");
    if (time.size() != 1 || unit.size() > 1 || !std::isfinite(time[0]) ||
        (!unit.empty() && !std::isfinite(unit[0])))
        file.fail("group '" + group->name + "'",
                  "expected time and timeUnitSI, numbers that are finite");
    return time[0] * (unit.empty() ? 1 : unit[0]);
}

}  // namespace

bool isOpenPmd(const NcHeader& header) {
    return !header.groups.empty() && !header.groups.front().text("openPMD").empty();
}

std::vector<OpenPmdIteration> openPmdIterationsOf(const NetcdfFile& file) {
    const NcGroup& root = file.header().groups.front();
    const std::string version = root.text("openPMD"), base = root.text("basePath");
    if (!version.starts_with("1."))
        file.fail("attribute 'openPMD'", fmt::format("expected version 1, found {}", version));
    if (base != "/data/%T/" && base != "/data/%T")
        file.fail("attribute 'basePath'", fmt::format("expected /data/%T/, found '{}'", base));
    Records records(file);
    std::vector<OpenPmdIteration> iterations;
    for (auto& [key, iteration] : records.found) {
        iteration.seconds = secondsOf(file, records.group("data/" + key.second));
        iterations.push_back(std::move(iteration));
    }
    if (iterations.empty())
        file.fail("data", "expected an iteration with records of meshes or particles, found none");
    return iterations;
}

void failComponent(const NetcdfFile& file, const OpenPmdComponent& component,
                   const std::string& what) {
    throw AttributeError(file.sentence(component.place, what));
}

OpenPmdNumbers openPmdNumbersOf(const NetcdfFile& file, const OpenPmdComponent& component) {
    OpenPmdNumbers numbers;
    const auto fail = [&](const std::string& what) { failComponent(file, component, what); };
    if (component.array) {
        if (!component.array->type) fail("expected numbers, found values of another type");
        numbers.type = *component.array->type;
        for (std::size_t i = 0; i < component.array->dimensions.size(); ++i)
            numbers.lengths.push_back(file.header().dimension(*component.array, i).length);
    } else {
        const NcAttribute& value = *component.own->find("value");
        const auto shape = component.own->numbers("shape");
        if (!value.type || component.own->numbers("value").size() != 1)
            fail("expected one number as its value");
        numbers.type = *value.type;
        for (const double length : shape) {
            if (!(length >= 0 && length < 0x1p62)) fail("expected a shape of lengths of 0 or more");
            numbers.lengths.push_back(static_cast<std::uint64_t>(length));
        }
    }
    double count = numbers.lengths.empty() ? 0 : 1;
    for (const std::uint64_t length : numbers.lengths) count *= static_cast<double>(length);
    numbers.count = static_cast<std::uint64_t>(std::min(count, 1e18));
    const std::string why = component.array ? file.tooLarge(*component.array, numbers.count)
                                            : file.tooLarge(numbers.type, numbers.count);
    if (!why.empty()) fail(why);
    return numbers;
}

double openPmdNumber(const NetcdfFile& file, const OpenPmdComponent& component,
                     const NcAttributes& attributes, const char* name, double otherwise) {
    if (!attributes.find(name)) return otherwise;
    const auto numbers = attributes.numbers(name);
    if (numbers.size() != 1 || !std::isfinite(numbers[0]))
        failComponent(file, component, fmt::format("expected {}, one number that is finite", name));
    return numbers[0];
}

std::string openPmdUnitsOf(const NetcdfFile& file, const OpenPmdComponent& component) {
    // In the order in which unitDimension has their powers.
    constexpr std::array<const char*, 7> kBase{"m", "kg", "s", "A", "K", "mol", "cd"};
    const double unit = openPmdNumber(file, component, *component.own, "unitSI", 1);
    std::string text = unit == 1 ? "" : fmt::format("{}", unit);
    const auto powers = component.record->numbers("unitDimension");
    for (std::size_t i = 0; i < std::min(powers.size(), kBase.size()); ++i) {
        if (powers[i] == 0) continue;
        text += fmt::format("{}{}{}", text.empty() ? "" : " ", kBase[i],
                            powers[i] == 1 ? "" : fmt::format("{}", powers[i]));
    }
    return text;
}

Values openPmdConstant(const OpenPmdComponent& component, const OpenPmdNumbers& numbers) {
    const Number value = std::get<1>(component.own->find("value")->value).front();
    return withType(numbers.type, [&]<typename T>(T) -> Values {
        return std::vector<T>(numbers.count,
                              std::visit([](auto v) { return static_cast<T>(v); }, value));
    });
}

}  // namespace timeseries
