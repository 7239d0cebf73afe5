// Collections of VTK files (.pvd): a file a step, or several that are parts of it.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "timeseries/readers/vtk/vtk_header.h"
#include "timeseries/readers/vtk/vtk_xml_numbers.h"

namespace timeseries {
namespace {

// A DataSet of a collection.
struct Listed {
    VtkMember member;
    std::pair<std::string, std::string> part;  // its group, and its part of that
};

bool before(const Listed& a, const Listed& b) {
    return a.member.time.value_or(0) < b.member.time.value_or(0);
}

// Parts of one time are one step. One part twice is left to be refused, but for files without a
// time: these are a step each, unless they are parts. REQUIRES: ascending.
std::vector<VtkMember> joined(std::vector<Listed> all) {
    std::vector<VtkMember> members;
    for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
        std::set<std::pair<std::string, std::string>> parts;
        for (end = first; end < all.size() && !before(all[first], all[end]); ++end)
            parts.insert(all[end].part);
        const bool areParts = parts.size() == end - first;
        for (std::size_t i = first; i < end; ++i)
            if (areParts && i > first)
                members.back().beside.push_back(std::move(all[i].member.path));
            else
                members.push_back(std::move(all[i].member));
    }
    return members;
}

}  // namespace

void expectOtherVtk(const std::filesystem::path& by, std::string_view place,
                    const std::filesystem::path& named) {
    std::error_code ignored;
    if (named.filename() == by.filename() && std::filesystem::equivalent(by, named, ignored))
        failVtk(by, place, "expected the names of other files, but it names itself");
}

std::vector<VtkMember> vtkMembersInOrder(const std::filesystem::path& path, std::string_view list,
                                         std::vector<VtkMember> members) {
    if (members.empty()) failVtk(path, list, "expected a file, found none");
    for (const VtkMember& each : members) {
        expectOtherVtk(path, list, each.path);
        for (const auto& part : each.beside) expectOtherVtk(path, list, part);
    }
    const auto timed =
        std::ranges::count_if(members, [](const VtkMember& each) { return !!each.time; });
    if (timed != 0 && static_cast<std::size_t>(timed) != members.size())
        failVtk(path, list, "expected a time of each file or of none");
    std::ranges::stable_sort(members, {},
                             [](const VtkMember& each) { return each.time.value_or(0); });
    for (std::size_t i = 1; timed && i < members.size(); ++i)
        if (*members[i - 1].time == *members[i].time)
            failVtk(path, list,
                    fmt::format("expected times that differ, found {} twice ({} and {})",
                                *members[i].time, members[i - 1].path.string(),
                                members[i].path.string()));
    return members;
}

bool isVtkCollection(const XmlFile& file) { return rootOf(file).attribute("type") == "Collection"; }

std::vector<VtkMember> readVtkCollection(const XmlFile& file) {
    const auto collections = named(rootOf(file), "Collection");
    if (collections.size() != 1) failVtk(file.path, "VTKFile", "expected one Collection");
    std::vector<Listed> listed;
    for (const XmlElement* set : named(*collections[0], "DataSet")) {
        const std::string_view name = set->attribute("file");
        if (name.empty()) failVtk(file.path, placeOf(*set), "expected the name of a file");
        VtkMember member{file.path.parent_path() / name, std::nullopt};
        if (set->has("timestep")) member.time = numbersOf<double>(file, *set, "timestep", 1)[0];
        listed.push_back(
            {std::move(member),
             {std::string(set->attribute("group")), std::string(set->attribute("part"))}});
    }
    std::ranges::stable_sort(listed, before);
    return vtkMembersInOrder(file.path, "Collection", joined(std::move(listed)));
}

}  // namespace timeseries
