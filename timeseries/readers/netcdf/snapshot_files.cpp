#include "timeseries/readers/netcdf/snapshot_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "timeseries/readers/text/cut_name.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

// "snap_010", "3" and ".hdf5" of such a name.
struct PartName {
    fs::path stem;  // with its folder
    std::string number, ending;
    fs::path with(std::uint64_t part) const {
        return fs::path(stem) += "." + std::to_string(part) + ending;
    }
    fs::path whole() const { return fs::path(stem) += ending; }
};

std::optional<PartName> partNameOf(const fs::path& path) {
    const std::string ending = path.extension().string();
    if (ending != ".hdf5" && ending != ".h5") return std::nullopt;
    const fs::path numbered = path.parent_path() / path.stem();
    const std::string number = numbered.extension().string();
    if (number.size() < 2 || number.find_first_not_of("0123456789", 1) != number.npos)
        return std::nullopt;
    return PartName{numbered.parent_path() / numbered.stem(), number.substr(1), ending};
}

double headerNumber(const NcHeader& header, const char* name) {
    const NcGroup* const about = header.findGroup("Header");
    const auto numbers = about ? about->numbers(name) : std::vector<double>();
    return numbers.empty() ? 0 : numbers[0];
}

// Unknown of a file that cannot be read.
std::optional<bool> isPart(const fs::path& path) {
    try {
        const NetcdfFile file(path, NetcdfFile::Header::New);
        return isSnapshot(file.header()) && headerNumber(file.header(), "NumFilesPerSnapshot") > 1;
    } catch (const FileError&) {
        return std::nullopt;
    }
}

// Of each kind of name all, if the first that can be read is one; each kind in natural order.
std::vector<fs::path> partsAmong(std::span<const fs::path> files) {
    constexpr std::size_t kMostAsked = 64;  // of one kind, all of which may be of another format
    std::map<std::string, std::vector<fs::path>> byShape;
    for (const fs::path& file : files)
        if (partNameOf(file))
            byShape[(file.parent_path() / shapeOf(file)).string()].push_back(file);
    std::vector<fs::path> parts;
    for (auto& [shape, alike] : byShape) {
        std::ranges::sort(alike, nameLess);
        std::optional<bool> areParts;
        for (std::size_t i = 0; !areParts && i < std::min(alike.size(), kMostAsked); ++i)
            areParts = isPart(alike[i]);
        if (areParts.value_or(false)) parts.insert(parts.end(), alike.begin(), alike.end());
    }
    return parts;
}

}  // namespace

bool isSnapshot(const NcHeader& header) {
    const NcGroup* const group = header.findGroup("Header");
    if (!group || !group->find("NumPart_ThisFile")) return false;
    // Of several some may hold no particle.
    if (headerNumber(header, "NumFilesPerSnapshot") > 1) return true;
    for (std::size_t type = 0; type < kSnapshotTypes; ++type)
        if (header.find(fmt::format("PartType{}/Coordinates", type), "")) return true;
    return false;
}

SnapshotFiles::SnapshotFiles(std::unique_ptr<NetcdfFile> opened) : open_(std::move(opened)) {
    const auto isThere = [](const fs::path& path) {
        std::error_code ignored;
        return fs::exists(path, ignored);
    };
    if (headerNumber(open_->header(), "Virtual") == 1) {
        const fs::path& path = open_->path();
        const fs::path first = fs::path(path).replace_extension(".0" + path.extension().string());
        if (!isThere(first))
            open_->fail("Header",
                        fmt::format("expected the files of the snapshot that it refers to "
                                    "beside it, but there is no {}",
                                    first.string()));
        open_ = std::make_unique<NetcdfFile>(first, NetcdfFile::Header::New);
        if (!isSnapshot(open_->header())) open_->fail("", "expected a snapshot of particles");
    }
    const double count = headerNumber(open_->header(), "NumFilesPerSnapshot");
    if (!(count > 1)) {
        paths_ = {open_->path()};
        known_ = {true};
        return;
    }
    const auto name = partNameOf(open_->path());
    if (count != std::floor(count) || !name)
        open_->fail(
            "Header",
            fmt::format("expected a file named as one of {} of a snapshot, NAME.0.hdf5 and so on",
                        count));
    for (std::uint64_t part = 0; static_cast<double>(part) < count; ++part) {
        paths_.push_back(name->with(part));
        if (!isThere(paths_.back()))
            open_->fail("Header", fmt::format("expected the {} files of the snapshot beside it, "
                                              "but there is no {}",
                                              count, paths_.back().string()));
    }
    known_ = NetcdfFile::triedTogether(paths_);
    const auto own = std::ranges::find(paths_, open_->path());
    if (own == paths_.end())
        open_->fail("Header",
                    fmt::format("expected a number of less than {} in the file's name", count));
    openIndex_ = static_cast<std::size_t>(own - paths_.begin());
    known_[openIndex_] = true;
}

const NetcdfFile& SnapshotFiles::at(std::size_t index) const {
    if (!open_ || openIndex_ != index) {
        open_.reset();
        open_ = std::make_unique<NetcdfFile>(
            paths_[index], known_[index] ? NetcdfFile::Header::Known : NetcdfFile::Header::New);
        openIndex_ = index;
        known_[index] = true;
    }
    return *open_;
}

std::vector<fs::path> firstPartsOf(std::vector<fs::path> files) {
    std::map<fs::path, fs::path> first;  // by the names without numbers
    for (const fs::path& part : partsAmong(files)) first.emplace(partNameOf(part)->whole(), part);
    std::erase_if(files, [&](const fs::path& file) {
        const auto name = partNameOf(file);
        const auto found = first.find(name ? name->whole() : file);
        return found != first.end() && found->second != file;
    });
    return files;
}

fs::path firstPartOf(const fs::path& file, std::span<const fs::path> firstParts) {
    if (std::ranges::find(firstParts, file) != firstParts.end()) return file;
    const auto name = partNameOf(file);
    const fs::path whole = name ? name->whole() : file;
    const auto found = std::ranges::find_if(firstParts, [&](const fs::path& each) {
        const auto its = partNameOf(each);
        return its && its->whole() == whole;
    });
    return found == firstParts.end() ? file : *found;
}

}  // namespace timeseries
