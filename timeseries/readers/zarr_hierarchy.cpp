#include "timeseries/readers/zarr_hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "timeseries/readers/numbered_names.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxZarrDepth = 16;
constexpr std::size_t kMaxNodes = 8192;     // as many as netCDF has variables
constexpr std::size_t kMaxEntries = 65536;  // of a group's folder
constexpr std::string_view kV3 = "zarr.json";

bool isThere(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

bool isNode(const fs::path& folder) {
    return isThere(folder / kV3) || isThere(folder / ".zarray") || isThere(folder / ".zgroup");
}

struct Node {
    bool isArray, isV3;
    ZarrJson metadata;
};

Node nodeAt(const fs::path& folder) {
    if (isThere(folder / kV3)) {
        Node node{false, true, readZarrJson(folder / kV3)};
        const ZarrJson* const type = jsonMember(&node.metadata, "node_type");
        node.isArray = jsonText(type) == "array";
        if (!node.isArray && jsonText(type) != "group")
            throw FileError(fmt::format("{}: node_type: expected array or group, found {}",
                                        (folder / kV3).string(), jsonBriefly(type)));
        return node;
    }
    if (isThere(folder / ".zarray")) return {true, false, readZarrJson(folder / ".zarray")};
    return {false, false, ZarrJson()};
}

ZarrJson attributesAt(const fs::path& folder, const Node& node) {
    if (node.isV3) {
        const ZarrJson* const own = jsonMember(&node.metadata, "attributes");
        return own ? *own : ZarrJson();
    }
    return isThere(folder / ".zattrs") ? readZarrJson(folder / ".zattrs") : ZarrJson();
}

// The folders in a group that are nodes, in natural order.
std::vector<fs::path> nodesIn(const fs::path& folder) {
    std::vector<fs::path> nodes;
    std::size_t seen = 0;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (++seen > kMaxEntries)
            throw FileError(fmt::format("{}: expected a group of at most {} files and folders",
                                        folder.string(), kMaxEntries));
        std::error_code ignored;
        if (!entry->path().filename().string().starts_with('.') && entry->is_directory(ignored) &&
            isNode(entry->path()))
            nodes.push_back(entry->path());
    }
    if (error)
        throw FileError(fmt::format("{}: expected a folder that can be listed, but {}",
                                    folder.string(), error.message()));
    std::ranges::sort(nodes, nameLess);
    return nodes;
}

void addArray(const fs::path& folder, const std::string& name, const Node& node,
              ZarrHierarchy& all) {
    try {
        ZarrArray array = node.isV3 ? zarrArrayOfV3(node.metadata)
                                    : zarrArrayOfV2(node.metadata, attributesAt(folder, node));
        array.folder = folder;
        array.name = name;
        all.arrays.push_back(std::move(array));
    } catch (const std::invalid_argument& flaw) {
        all.damaged.push_back({name, fmt::format("{}: {}", folder.string(), flaw.what())});
    }
}

void addNode(const fs::path& folder, const std::string& name, int depth, ZarrHierarchy& all) {
    // A link to a group around it has no end, too.
    if (depth > kMaxZarrDepth)
        throw FileError(fmt::format("{}: expected groups at most {} deep, found more",
                                    folder.string(), kMaxZarrDepth));
    if (all.groups.size() + all.arrays.size() + all.damaged.size() >= kMaxNodes)
        throw FileError(fmt::format("{}: expected at most {} groups and arrays, found more",
                                    all.folder.string(), kMaxNodes));
    std::optional<Node> node;
    try {
        node = nodeAt(folder);
        if (node->isArray) return addArray(folder, name, *node, all);
        all.groups.push_back({name, attributesAt(folder, *node)});
    } catch (const FileError& error) {  // costs no other
        all.damaged.push_back({name, error.what()});
        return;
    }
    for (const fs::path& each : nodesIn(folder)) {
        const std::string own = each.filename().string();
        addNode(each, name.empty() ? own : name + '/' + own, depth + 1, all);
    }
}

fs::path folderOf(const fs::path& path) {
    std::error_code ignored;
    fs::path folder = fs::is_directory(path, ignored) ? path : path.parent_path();
    if (folder.empty()) folder = ".";
    // Without a slash at its end.
    return folder.has_filename() || !folder.has_relative_path() ? folder : folder.parent_path();
}

// A group's own metadata, not an array's.
bool isGroup(const fs::path& folder) {
    try {
        return isNode(folder) && !nodeAt(folder).isArray;
    } catch (const FileError&) {
        return false;
    }
}

}  // namespace

bool isZarr(const fs::path& path) {
    static constexpr std::array kFiles{".zgroup", ".zarray", ".zattrs", ".zmetadata", "zarr.json"};
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return isNode(path);
    return std::ranges::find(kFiles, path.filename().string()) != kFiles.end() &&
           fs::is_regular_file(path, ignored) && isNode(folderOf(path));
}

ZarrHierarchy zarrHierarchyOf(const fs::path& path) {
    fs::path folder = folderOf(path);
    const Node node = nodeAt(folder);
    ZarrHierarchy all;
    all.format = node.isV3 ? "Zarr v3" : "Zarr v2";
    std::string name;
    if (node.isArray) {
        // "." has a name, too.
        const fs::path whole = fs::absolute(folder).lexically_normal();
        name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
        const fs::path around = folder / "..";
        if (isGroup(around)) {
            all.only = name;
            folder =
                folder.has_parent_path() && folder.filename() != "." && folder.filename() != ".."
                    ? folder.parent_path()
                    : around;
            name.clear();
        } else if (name.ends_with(".zarr")) {
            name.resize(name.size() - 5);
        }
    }
    all.folder = folder;
    addNode(folder, name, 0, all);
    return all;
}

}  // namespace timeseries
