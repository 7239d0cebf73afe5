// The elements of a VTK XML file, as far as its appended data, by expat: names, attributes and
// where text lies; the text itself is not kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace timeseries {

constexpr std::size_t kMaxXmlWord = 255;

struct XmlElement {
    std::string name;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<XmlElement> children;
    // Text directly inside: its words, its characters that are no blanks, and where it begins.
    std::uint64_t words = 0, characters = 0, textAt = 0;
    std::string notNumber;  // the first word of a DataArray's text that is no number of its type
    std::string firstWord;  // of the text of a DataArray of numbers, at most kMaxXmlWord of it
    std::uint64_t line = 0;

    // "" when there is none; without blanks around it.
    std::string_view attribute(std::string_view name) const;
    bool has(std::string_view name) const;
};

struct XmlFile {
    std::filesystem::path path;
    XmlElement root;
    std::uint64_t bytes = 0;       // of the file
    std::uint64_t appendedAt = 0;  // the byte after the '_'; 0 when nothing is appended
    std::string appendedEncoding;  // "raw" or "base64"
};

// Throws FileError when it is no well-formed XML, declares a document type (whose entities could
// expand without end), or has more elements than any grid needs.
XmlFile readXml(const std::filesystem::path& path);

// A file as far as it can be read: of what its flaw cuts off, nothing within the grid is there.
struct XmlSoFar {
    XmlFile file;
    std::string flaw;  // the sentence with which readXml() refuses it; "" for none
};
// Throws FileError when it cannot be opened.
XmlSoFar readXmlSoFar(const std::filesystem::path& path);

}  // namespace timeseries
