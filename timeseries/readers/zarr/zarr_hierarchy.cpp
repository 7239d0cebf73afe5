#include "timeseries/readers/zarr/zarr_hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "timeseries/readers/text/numbered_names.h"
#include "timeseries/readers/zarr/zarr_zip.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxZarrDepth = 16;
constexpr std::size_t kMaxNodes = 8192;  // as many as netCDF has variables
constexpr std::string_view kV3 = "zarr.json";

struct Node {
    bool isArray, isV3;
    ZarrJson metadata;
};

Node nodeAt(const ZarrStore& store, const std::string& folder) {
    const std::string v3 = zarrJoined(folder, std::string(kV3)), v2 = zarrJoined(folder, ".zarray");
    if (store.isThere(v3)) {
        Node node{false, true, readZarrJson(store, v3)};
        const ZarrJson* const type = jsonMember(&node.metadata, "node_type");
        node.isArray = jsonText(type) == "array";
        if (!node.isArray && jsonText(type) != "group")
            throw FileError(fmt::format("{}: node_type: expected array or group, found {}",
                                        store.told(v3), jsonBriefly(type)));
        return node;
    }
    if (store.isThere(v2)) return {true, false, readZarrJson(store, v2)};
    return {false, false, ZarrJson()};
}

ZarrJson attributesAt(const ZarrStore& store, const std::string& folder, const Node& node) {
    if (node.isV3) {
        const ZarrJson* const own = jsonMember(&node.metadata, "attributes");
        return own ? *own : ZarrJson();
    }
    const std::string file = zarrJoined(folder, ".zattrs");
    return store.isThere(file) ? readZarrJson(store, file) : ZarrJson();
}

// The folders in a group that are nodes, by their own names, in natural order.
std::vector<std::string> nodesIn(const ZarrStore& store, const std::string& folder) {
    std::vector<std::string> nodes = store.foldersIn(folder);
    std::erase_if(nodes, [&](const std::string& name) {
        return name.starts_with('.') || !isZarrNode(store, zarrJoined(folder, name));
    });
    std::ranges::sort(nodes, nameLess);
    return nodes;
}

void addArray(const std::string& folder, const std::string& name, const Node& node,
              ZarrHierarchy& all) {
    try {
        ZarrArray array =
            node.isV3 ? zarrArrayOfV3(node.metadata)
                      : zarrArrayOfV2(node.metadata, attributesAt(*all.store, folder, node));
        array.folder = folder;
        array.name = name;
        all.arrays.push_back(std::move(array));
    } catch (const std::invalid_argument& flaw) {
        all.damaged.push_back({name, fmt::format("{}: {}", all.store->told(folder), flaw.what())});
    }
}

void addNode(const std::string& folder, const std::string& name, int depth, ZarrHierarchy& all) {
    // A link to a group around it has no end, too.
    if (depth > kMaxZarrDepth)
        throw FileError(fmt::format("{}: expected groups at most {} deep, found more",
                                    all.store->told(folder), kMaxZarrDepth));
    if (all.groups.size() + all.arrays.size() + all.damaged.size() >= kMaxNodes)
        throw FileError(fmt::format("{}: expected at most {} groups and arrays, found more",
                                    all.store->told(""), kMaxNodes));
    std::optional<Node> node;
    try {
        node = nodeAt(*all.store, folder);
        if (node->isArray) return addArray(folder, name, *node, all);
        all.groups.push_back({name, attributesAt(*all.store, folder, *node)});
    } catch (const FileError& error) {  // costs no other
        all.damaged.push_back({name, error.what()});
        return;
    }
    for (const std::string& own : nodesIn(*all.store, folder))
        addNode(zarrJoined(folder, own), zarrJoined(name, own), depth + 1, all);
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
        const auto store = zarrFolder(folder);
        return isZarrNode(*store, "") && !nodeAt(*store, "").isArray;
    } catch (const FileError&) {
        return false;
    }
}

// One that says that it is one, but cannot be opened, shall be told as one.
bool isZarrZip(const fs::path& path) {
    if (!isZip(path)) return false;
    try {
        return isZarrNode(*zarrZip(path), "");
    } catch (const FileError&) {
        return path.string().ends_with(".zarr.zip");
    }
}

// An array that is a store's outermost folder is called as the store is.
std::string nameOf(const fs::path& path) {
    // "." has a name, too.
    const fs::path whole = fs::absolute(path).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

void dropEnding(std::string& name, std::string_view ending) {
    if (name.ends_with(ending)) name.resize(name.size() - ending.size());
}

ZarrHierarchy zipHierarchyOf(const fs::path& path) {
    ZarrHierarchy all;
    all.store = zarrZip(path);
    const Node node = nodeAt(*all.store, "");
    all.format = node.isV3 ? "Zarr v3 in a zip file" : "Zarr v2 in a zip file";
    std::string name = node.isArray ? nameOf(path) : "";
    dropEnding(name, ".zip");
    dropEnding(name, ".zarr");
    addNode("", name, 0, all);
    return all;
}

}  // namespace

bool isZarr(const fs::path& path) {
    static constexpr std::array kFiles{".zgroup", ".zarray", ".zattrs", ".zmetadata", "zarr.json"};
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return isZarrNode(*zarrFolder(path), "");
    if (!fs::is_regular_file(path, ignored)) return false;
    if (std::ranges::find(kFiles, path.filename().string()) == kFiles.end()) return isZarrZip(path);
    return isZarrNode(*zarrFolder(folderOf(path)), "");
}

ZarrHierarchy zarrHierarchyOf(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_regular_file(path, ignored) && isZip(path)) return zipHierarchyOf(path);
    fs::path folder = folderOf(path);
    ZarrHierarchy all;
    all.store = zarrFolder(folder);
    const Node node = nodeAt(*all.store, "");
    all.format = node.isV3 ? "Zarr v3" : "Zarr v2";
    std::string name;
    if (node.isArray) {
        name = nameOf(folder);
        const fs::path around = folder / "..";
        if (isGroup(around)) {
            all.only = name;
            all.store = zarrFolder(folder.has_parent_path() && folder.filename() != "." &&
                                           folder.filename() != ".."
                                       ? folder.parent_path()
                                       : around);
            name.clear();
        } else {
            dropEnding(name, ".zarr");
        }
    }
    addNode("", name, 0, all);
    return all;
}

}  // namespace timeseries
