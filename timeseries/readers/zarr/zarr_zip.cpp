#include "timeseries/readers/zarr/zarr_zip.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

#include "timeseries/readers/limits.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

using Archive = std::unique_ptr<zip_t, void (*)(zip_t*)>;
using Member = std::unique_ptr<zip_file_t, int (*)(zip_file_t*)>;

// Of a deflated member parts are had by unpacking all of it.
constexpr std::uint64_t kMostUnpacked = std::uint64_t{1} << 28;
// Beside what its bytes may unpack to.
constexpr std::uint64_t kFree = 1 << 20;

std::string textOf(zip_error_t* error) {
    std::string text = zip_error_strerror(error);
    std::ranges::replace(text, '\n', ' ');
    return text;
}

Archive opened(const fs::path& path) {
    expectFile(path);
    int code = 0;
    Archive archive(zip_open(path.c_str(), ZIP_RDONLY, &code), zip_discard);
    if (archive) return archive;
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string why = textOf(&error);
    zip_error_fini(&error);
    throw FileError(
        fmt::format("{}: expected a whole zip file, with its list of members at the end, found: {}",
                    path.string(), why));
}

class ZarrZip final : public ZarrStore {
 public:
    explicit ZarrZip(const fs::path& path);

    bool isOneFile() const override { return true; }
    bool isThere(const std::string& file) const override { return members_.contains(root_ + file); }
    std::vector<std::string> foldersIn(const std::string& folder) const override;
    std::unique_ptr<ZarrStoreFile> open(const std::string& name) const override;
    double bytesBelow(const std::string& folder, double enough) const override;

    // All of a member that is deflated. Of the last that was asked for it is kept.
    const ZarrBytes& unpacked(std::uint64_t index, std::uint64_t bytes) const;
    // A member from its start, or a part of one that is stored.
    ZarrBytes readFrom(std::uint64_t index, std::uint64_t from, std::uint64_t count,
                       bool toItsEnd) const;

 private:
    using Members = std::map<std::string, std::uint64_t>;  // places in the archive by their names
    std::pair<Members::const_iterator, Members::const_iterator> below(
        const std::string& folder) const;
    void findRoot();

    Archive archive_;
    std::uint64_t archiveBytes_ = 0;
    Members members_;
    std::string root_;  // "" or "store.zarr/", in which the hierarchy lies
    mutable std::uint64_t unpackedIndex_ = 0;
    mutable ZarrBytes unpacked_;  // empty: none
};

class MemberOfZip final : public ZarrStoreFile {
 public:
    MemberOfZip(const ZarrZip& zip, const zip_stat_t& member)
        : ZarrStoreFile(member.size),
          zip_(zip),
          index_(member.index),
          stored_(member.comp_method == ZIP_CM_STORE) {}

 private:
    ZarrBytes readWithin(std::uint64_t from, std::uint64_t count) override {
        if (stored_ || count == bytes())
            return zip_.readFrom(index_, from, count, count == bytes());
        if (bytes() > kMostUnpacked)
            throw std::invalid_argument(
                fmt::format("expected a member that is stored, or deflated from at most {} bytes, "
                            "for parts of it are read, found one from {}",
                            kMostUnpacked, bytes()));
        const ZarrBytes& all = zip_.unpacked(index_, bytes());
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(from);
        return {first, first + static_cast<std::ptrdiff_t>(count)};
    }

    const ZarrZip& zip_;  // which outlives it
    std::uint64_t index_;
    bool stored_;
};

ZarrZip::ZarrZip(const fs::path& path) : ZarrStore(path), archive_(opened(path)) {
    std::error_code error;
    archiveBytes_ = fs::file_size(path, error);
    const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
    for (zip_int64_t i = 0; i < count; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        // As bytes: what they mean in a code page is nothing to Zarr.
        const char* const name = zip_get_name(archive_.get(), index, ZIP_FL_ENC_RAW);
        if (name && *name) members_[name] = index;
    }
    findRoot();
}

// The outermost folder where the hierarchy's metadata lie there; else the only one in it where they
// do.
void ZarrZip::findRoot() {
    if (isZarrNode(*this, "")) return;
    std::vector<std::string> nodes = foldersIn("");
    std::erase_if(nodes, [&](const std::string& name) { return !isZarrNode(*this, name); });
    if (nodes.size() == 1) root_ = nodes.front() + '/';
}

std::pair<ZarrZip::Members::const_iterator, ZarrZip::Members::const_iterator> ZarrZip::below(
    const std::string& folder) const {
    const std::string start = root_ + folder + (folder.empty() ? "" : "/");
    std::string beyond = start;
    if (beyond.empty()) return {members_.begin(), members_.end()};
    ++beyond.back();  // of '/', which ends it
    return {members_.lower_bound(start), members_.lower_bound(beyond)};
}

std::vector<std::string> ZarrZip::foldersIn(const std::string& folder) const {
    const std::size_t start = root_.size() + (folder.empty() ? 0 : folder.size() + 1);
    std::vector<std::string> folders;
    auto [at, end] = below(folder);
    while (at != end) {
        const auto slash = at->first.find('/', start);
        if (slash == std::string::npos || slash == start) {
            ++at;
            continue;
        }
        if (folders.size() == kMaxZarrEntries)
            throw FileError(fmt::format("{}: expected a group of at most {} folders", told(folder),
                                        kMaxZarrEntries));
        folders.push_back(at->first.substr(start, slash - start));
        std::string beyond = at->first.substr(0, slash + 1);
        ++beyond.back();
        at = members_.lower_bound(beyond);
    }
    return folders;
}

std::unique_ptr<ZarrStoreFile> ZarrZip::open(const std::string& name) const {
    const auto found = members_.find(root_ + name);
    if (found == members_.end()) return nullptr;
    zip_stat_t member;
    zip_stat_init(&member);
    constexpr zip_uint64_t kNeeded =
        ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
    if (zip_stat_index(archive_.get(), found->second, 0, &member) != 0 ||
        (member.valid & kNeeded) != kNeeded)
        throw std::invalid_argument("expected a member whose size is told");
    member.index = found->second;
    if (member.encryption_method != ZIP_EM_NONE)
        throw std::invalid_argument("expected a member that is not encrypted");
    const bool stored = member.comp_method == ZIP_CM_STORE;
    if (!stored && member.comp_method != ZIP_CM_DEFLATE)
        throw std::invalid_argument(fmt::format(
            "expected a member that is stored or deflated, found method {}", member.comp_method));
    // Sizes are but said, and memory shall not be taken for what cannot be there.
    if (member.comp_size > archiveBytes_ ||
        (stored ? member.size != member.comp_size
                : member.size > kMaxInflated * member.comp_size + kFree))
        throw std::invalid_argument(
            fmt::format("expected a size that {} bytes of a zip file of {} hold, found {}",
                        member.comp_size, archiveBytes_, member.size));
    return std::make_unique<MemberOfZip>(*this, member);
}

double ZarrZip::bytesBelow(const std::string& folder, double enough) const {
    // Members may lie over each other; all are within the file.
    const double most = static_cast<double>(archiveBytes_) * kMaxInflated;
    double bytes = 0;
    for (auto [at, end] = below(folder); bytes < enough && at != end; ++at) {
        zip_stat_t member;
        zip_stat_init(&member);
        if (!isZarrMetadata(fs::path(at->first).filename().string()) &&
            zip_stat_index(archive_.get(), at->second, 0, &member) == 0)
            bytes += std::min(static_cast<double>(member.size), most);
    }
    return std::min(bytes, most);
}

ZarrBytes ZarrZip::readFrom(std::uint64_t index, std::uint64_t from, std::uint64_t count,
                            bool toItsEnd) const {
    const Member member(zip_fopen_index(archive_.get(), index, 0), zip_fclose);
    if (!member)
        throw std::invalid_argument("expected a member that can be read, found: " +
                                    textOf(zip_get_error(archive_.get())));
    const auto fail = [&] {
        throw std::invalid_argument(
            fmt::format("expected {} bytes at {} of a member that is whole, found: {}", count, from,
                        textOf(zip_file_get_error(member.get()))));
    };
    if (from > 0 && zip_fseek(member.get(), static_cast<zip_int64_t>(from), SEEK_SET) != 0) fail();
    ZarrBytes bytes(count);
    for (std::uint64_t read = 0; read < count;) {
        const zip_int64_t more = zip_fread(member.get(), bytes.data() + read, count - read);
        if (more <= 0) fail();
        read += static_cast<std::uint64_t>(more);
    }
    // Only whoever asks for more is told whether the checksum is right.
    std::byte beyond;
    if (toItsEnd && zip_fread(member.get(), &beyond, 1) != 0) fail();
    return bytes;
}

const ZarrBytes& ZarrZip::unpacked(std::uint64_t index, std::uint64_t bytes) const {
    if (unpacked_.empty() || unpackedIndex_ != index) {
        unpacked_.clear();
        unpacked_ = readFrom(index, 0, bytes, true);
        unpackedIndex_ = index;
    }
    return unpacked_;
}

}  // namespace

bool isZip(const fs::path& path) {
    constexpr std::string_view kStart = "PK\3\4";
    if (!flawOfFile(path).empty()) return false;
    std::string start(kStart.size(), '\0');
    std::ifstream(path, std::ios::binary).read(start.data(), std::ssize(start));
    return start == kStart;
}

std::unique_ptr<ZarrStore> zarrZip(const fs::path& path) { return std::make_unique<ZarrZip>(path); }

}  // namespace timeseries
