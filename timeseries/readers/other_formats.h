// Formats that are not read, told by how their files begin: so that who opens one is told what it
// is.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace timeseries {

// The longest beginning that a format is told by: comments may stand before an XML file's root.
constexpr std::size_t kBeginningBytes = 1024;

// "a NIfTI file"; "" when it is not known. `start`: the file's first kBeginningBytes, of one that
// is shorter all. REQUIRES: it does not begin as one that is read. These may hold the signs of
// others further on.
std::string otherFormat(std::string_view start);

// What the first bytes of a gzip file unpack to, as far as they go; other files' as they are.
std::string unpackedBeginning(std::string_view start);

// "a VTK file of type UnstructuredGrid"; "" for the types that are read, and for other files.
std::string otherVtk(std::string_view start);
// As otherVtk, of the type that a file states.
std::string otherVtkType(std::string_view type);

// As otherFormat, of a folder that is one data set: "an ADIOS2 file (BP)".
std::string otherFolder(const std::filesystem::path& folder);

// The sentence for one of these: "PATH is a NIfTI file; isochron reads ...".
std::string notReadSentence(const std::filesystem::path& path, std::string_view what);

// The first member of a VTK collection as its file names it; "" where the beginning tells none.
std::string firstMember(std::string_view collectionStart);

}  // namespace timeseries
