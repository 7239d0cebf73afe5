// ParaView's lists of the files of a series (.vtu.series): JSON that names each and its time.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {
namespace {

constexpr std::uintmax_t kMostListBytes = 64 << 20;  // of a list: a million files

}  // namespace

std::vector<VtkMember> readVtkSeries(const std::filesystem::path& path) {
    using nlohmann::json;
    if (std::filesystem::file_size(path) > kMostListBytes)
        failVtk(path, "", "expected a list of files of at most 64 MB");
    std::ifstream file(path, std::ios::binary);
    const json root = json::parse(file, nullptr, false);
    const auto files = root.is_object() ? root.find("files") : root.end();
    if (!root.is_object() || files == root.end() || !files->is_array())
        failVtk(path, "", "expected JSON with a list of \"files\"");
    std::vector<VtkMember> members;
    for (const json& each : *files) {
        const std::string place = fmt::format("files[{}]", members.size());
        const auto name = each.is_object() ? each.find("name") : each.end();
        if (!each.is_object() || name == each.end() || !name->is_string())
            failVtk(path, place, "expected the \"name\" of a file");
        VtkMember member{path.parent_path() / name->get<std::string>(), std::nullopt};
        if (const auto time = each.find("time"); time != each.end()) {
            if (!time->is_number() || !std::isfinite(time->get<double>()))
                failVtk(path, place, "expected a finite number as \"time\"");
            member.time = time->get<double>();
        }
        members.push_back(std::move(member));
    }
    return vtkMembersInOrder(path, "files", std::move(members));
}

}  // namespace timeseries
