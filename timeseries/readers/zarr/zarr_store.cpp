#include "timeseries/readers/zarr/zarr_store.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

class FileInFolder final : public ZarrStoreFile {
 public:
    FileInFolder(std::ifstream file, std::uint64_t bytes, std::int64_t written)
        : ZarrStoreFile(bytes, written), file_(std::move(file)) {}

 private:
    ZarrBytes readWithin(std::uint64_t from, std::uint64_t count) override {
        ZarrBytes bytes(count);
        file_.seekg(static_cast<std::streamoff>(from));
        file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
        if (!file_) throw std::invalid_argument("expected a file that can be read");
        return bytes;
    }

    std::ifstream file_;
};

class ZarrFolder final : public ZarrStore {
 public:
    using ZarrStore::ZarrStore;

    bool isOneFile() const override { return false; }
    bool isThere(const std::string& file) const override {
        std::error_code ignored;
        return fs::exists(path_ / file, ignored);
    }
    std::vector<std::string> foldersIn(const std::string& folder) const override;
    std::unique_ptr<ZarrStoreFile> open(const std::string& name) const override;
    double bytesBelow(const std::string& folder, double enough) const override;
};

std::vector<std::string> ZarrFolder::foldersIn(const std::string& folder) const {
    std::vector<std::string> folders;
    std::size_t seen = 0;
    std::error_code error;
    for (fs::directory_iterator entry(path_ / folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (++seen > kMaxZarrEntries)
            throw FileError(fmt::format("{}: expected a group of at most {} files and folders",
                                        told(folder), kMaxZarrEntries));
        std::error_code ignored;
        if (entry->is_directory(ignored)) folders.push_back(entry->path().filename().string());
    }
    if (error)
        throw FileError(fmt::format("{}: expected a folder that can be listed, but {}",
                                    told(folder), error.message()));
    return folders;
}

std::unique_ptr<ZarrStoreFile> ZarrFolder::open(const std::string& name) const {
    const fs::path path = path_ / name;
    std::error_code error;
    if (fs::symlink_status(path, error).type() == fs::file_type::not_found) return nullptr;
    if (const std::string flaw = flawOfFile(path); !flaw.empty()) throw std::invalid_argument(flaw);
    std::ifstream file(path, std::ios::binary);
    const std::uint64_t bytes = fs::file_size(path, error);
    if (!file || error) throw std::invalid_argument("expected a file that can be read");
    const auto written = fs::last_write_time(path, error).time_since_epoch().count();
    return std::make_unique<FileInFolder>(std::move(file), bytes, written);
}

double ZarrFolder::bytesBelow(const std::string& folder, double enough) const {
    constexpr int kMostFiles = 1 << 20;
    double bytes = 0;
    int files = 0;
    std::error_code error;
    for (fs::recursive_directory_iterator file(path_ / folder, error), end;
         !error && bytes < enough && file != end && files < kMostFiles;
         file.increment(error), ++files) {
        std::error_code ignored;
        if (file->is_regular_file(ignored) && !isZarrMetadata(file->path().filename().string()))
            bytes += static_cast<double>(file->file_size(ignored));
    }
    return bytes;
}

}  // namespace

ZarrBytes ZarrStoreFile::read(std::uint64_t from, std::uint64_t count) {
    if (count > bytes_ || from > bytes_ - count)
        throw std::invalid_argument(
            fmt::format("expected {} bytes at {}, found a file of {}", count, from, bytes_));
    return readWithin(from, count);
}

std::string ZarrStore::told(const std::string& name) const {
    return name.empty() ? path_.string() : (path_ / name).string();
}

bool isZarrMetadata(const std::string& fileName) {
    return fileName.starts_with('.') || fileName == "zarr.json";
}

bool isZarrNode(const ZarrStore& store, const std::string& folder) {
    return store.isThere(zarrJoined(folder, "zarr.json")) ||
           store.isThere(zarrJoined(folder, ".zarray")) ||
           store.isThere(zarrJoined(folder, ".zgroup"));
}

std::string zarrJoined(const std::string& folder, const std::string& name) {
    return folder.empty() ? name : name.empty() ? folder : folder + '/' + name;
}

std::unique_ptr<ZarrStore> zarrFolder(const fs::path& folder) {
    return std::make_unique<ZarrFolder>(folder);
}

}  // namespace timeseries
