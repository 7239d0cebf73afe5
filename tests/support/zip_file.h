// Zip files for tests, byte by byte as PKWARE's APPNOTE 6.3 has them (sections 4.3 and 4.5.3).
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/deflated.h"
#include "tests/support/files.h"

namespace tests::zip {

struct Member {
    std::string name, bytes;
    bool deflate = false;
    // What its headers say against what it is.
    std::optional<std::uint64_t> saidSize = {}, saidPacked = {};
    std::optional<unsigned> saidMethod = {}, saidChecksum = {};
    unsigned flags = 0;  // 1: encrypted
};

struct Options {
    bool zip64 = false;  // sizes and places as 64-bit numbers, needed or not
    std::optional<std::uint64_t> saidCount = {};
};

// What a member's local header and its entry in the list at the end have in common, from the
// version on; `offset` where it is told.
struct Heads {
    std::string common, extra, offset;
};

inline Heads headsOf(const Member& member, const std::string& packed, std::uint64_t at,
                     bool zip64) {
    const std::uint64_t size = member.saidSize.value_or(member.bytes.size()),
                        packedSize = member.saidPacked.value_or(packed.size());
    const unsigned method = member.saidMethod.value_or(member.deflate ? 8 : 0);
    const auto crc = static_cast<unsigned>(member.saidChecksum.value_or(
        static_cast<unsigned>(crc32(0, reinterpret_cast<const Bytef*>(member.bytes.data()),
                                    static_cast<unsigned>(member.bytes.size())))));
    const bool wide = zip64 || size > 0xFFFFFFFE || packedSize > 0xFFFFFFFE;
    Heads heads;
    heads.common = littleEndian(wide ? 45 : 20, 2) + littleEndian(member.flags, 2) +
                   littleEndian(method, 2) + littleEndian(0, 4) + littleEndian(crc, 4) +
                   littleEndian(wide ? 0xFFFFFFFF : packedSize, 4) +
                   littleEndian(wide ? 0xFFFFFFFF : size, 4) + littleEndian(member.name.size(), 2);
    if (wide)
        heads.extra = littleEndian(1, 2) + littleEndian(16, 2) + littleEndian(size, 8) +
                      littleEndian(packedSize, 8);
    heads.offset = littleEndian(at, 4);
    return heads;
}

inline std::string zipOf(const std::vector<Member>& members, const Options& options = {}) {
    std::string file, list;
    for (const Member& member : members) {
        const std::string packed = member.deflate ? deflated(member.bytes, -15) : member.bytes;
        const Heads heads = headsOf(member, packed, file.size(), options.zip64);
        list += "PK\1\2" + littleEndian(45, 2) + heads.common +
                littleEndian(heads.extra.size(), 2) + littleEndian(0, 2) + littleEndian(0, 2) +
                littleEndian(0, 2) + littleEndian(0, 4) + heads.offset + member.name + heads.extra;
        file += "PK\3\4" + heads.common + littleEndian(heads.extra.size(), 2) + member.name +
                heads.extra + packed;
    }
    const std::uint64_t start = file.size(), count = options.saidCount.value_or(members.size());
    file += list;
    if (options.zip64) {
        const std::uint64_t end = file.size();
        file += "PK\6\6" + littleEndian(44, 8) + littleEndian(45, 2) + littleEndian(45, 2) +
                littleEndian(0, 4) + littleEndian(0, 4) + littleEndian(count, 8) +
                littleEndian(count, 8) + littleEndian(list.size(), 8) + littleEndian(start, 8);
        file += "PK\6\7" + littleEndian(0, 4) + littleEndian(end, 8) + littleEndian(1, 4);
        return file + "PK\5\6" + littleEndian(0, 4) + littleEndian(0xFFFF, 2) +
               littleEndian(0xFFFF, 2) + littleEndian(0xFFFFFFFF, 4) + littleEndian(0xFFFFFFFF, 4) +
               littleEndian(0, 2);
    }
    return file + "PK\5\6" + littleEndian(0, 4) + littleEndian(count, 2) + littleEndian(count, 2) +
           littleEndian(list.size(), 4) + littleEndian(start, 4) + littleEndian(0, 2);
}

// All files below a folder, in order of their names, which begin with `start`.
inline std::vector<Member> membersOf(const std::filesystem::path& folder,
                                     const std::string& start = "", bool deflate = false) {
    std::vector<Member> members;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            members.push_back({start + entry.path().lexically_relative(folder).string(),
                               readBytes(entry.path()), deflate});
    std::ranges::sort(members, {}, &Member::name);
    return members;
}

}  // namespace tests::zip
