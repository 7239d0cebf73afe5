// What a Zarr hierarchy is kept in, a "store" (Zarr specification 3.1, "Stores"): files by their
// names in it, "a/b/.zarray"; "" names its outermost folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "timeseries/readers/zarr/zarr_codecs.h"

namespace timeseries {

// A file that is asked for parts of itself.
class ZarrStoreFile {
 public:
    explicit ZarrStoreFile(std::uint64_t bytes, std::int64_t written = 0)
        : bytes_(bytes), written_(written) {}
    virtual ~ZarrStoreFile() = default;
    ZarrStoreFile(const ZarrStoreFile&) = delete;
    ZarrStoreFile& operator=(const ZarrStoreFile&) = delete;

    std::uint64_t bytes() const { return bytes_; }
    // When it was written last, in the file system's own count; 0 where the store is one file.
    std::int64_t written() const { return written_; }
    // REQUIRES: it may take so much memory. Throws std::invalid_argument: what was expected and
    // found.
    ZarrBytes read(std::uint64_t from, std::uint64_t count);

 private:
    // REQUIRES: they are within the file.
    virtual ZarrBytes readWithin(std::uint64_t from, std::uint64_t count) = 0;

    std::uint64_t bytes_;
    std::int64_t written_;
};

// One thread at a time.
class ZarrStore {
 public:
    explicit ZarrStore(std::filesystem::path path) : path_(std::move(path)) {}
    virtual ~ZarrStore() = default;
    ZarrStore(const ZarrStore&) = delete;
    ZarrStore& operator=(const ZarrStore&) = delete;

    // What sentences call a file or a folder of it.
    std::string told(const std::string& name) const;
    virtual bool isOneFile() const = 0;
    virtual bool isThere(const std::string& file) const = 0;
    // Their own names, in no order. Throws FileError.
    virtual std::vector<std::string> foldersIn(const std::string& folder) const = 0;
    // Null when there is no such file. Throws std::invalid_argument: what was expected and found.
    virtual std::unique_ptr<ZarrStoreFile> open(const std::string& name) const = 0;
    // How many bytes the files below a folder have that are no metadata; of more than `enough` but
    // so many.
    virtual double bytesBelow(const std::string& folder, double enough) const = 0;

 protected:
    std::filesystem::path path_;
};

constexpr std::size_t kMaxZarrEntries = 65536;  // of a group's folder

// Whether a file of this name, without folders, is a hierarchy's metadata.
bool isZarrMetadata(const std::string& fileName);

// Whether a group's or an array's metadata are in a folder.
bool isZarrNode(const ZarrStore& store, const std::string& folder);

// "a/b"; where one is "" the other.
std::string zarrJoined(const std::string& folder, const std::string& name);

std::unique_ptr<ZarrStore> zarrFolder(const std::filesystem::path& folder);

}  // namespace timeseries
