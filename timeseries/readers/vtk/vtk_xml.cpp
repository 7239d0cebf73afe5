#include "timeseries/readers/vtk/vtk_xml.h"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>

#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {
namespace {

constexpr std::size_t kMaxElements = std::size_t{1} << 18;
constexpr std::size_t kMaxDepth = 32;
// Of one tag or comment: expat 2.5 looks at it from its start again with every piece of the file
// (CVE-2023-52425), which takes 35 s for 60 MB.
constexpr std::uint64_t kMaxTokenBytes = std::uint64_t{1} << 20;

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// An element whose end has not come.
struct Open {
    XmlElement element;
    const VtkType* numbers = nullptr;  // what the words of its text have to be
    std::string word;                  // of its text, as much of it as is kept; "" between words
};

// expat calls back through C, so nothing may be thrown here: a refusal is kept and parsing stops.
struct Parsing {
    XML_Parser parser;
    XmlElement root;
    std::vector<Open> open;  // from the root down
    std::size_t elements = 0;
    std::string refusal;
    std::uint64_t appendedTagEnd = 0;
    std::string appendedEncoding;

    void refuse(std::string why) {
        if (refusal.empty()) refusal = std::move(why);
        XML_StopParser(parser, XML_FALSE);
    }
};

void start(void* user, const XML_Char* name, const XML_Char** attributes) {
    auto& parsing = *static_cast<Parsing*>(user);
    if (++parsing.elements > kMaxElements)
        return parsing.refuse(fmt::format("expected at most {} elements", kMaxElements));
    if (parsing.open.size() >= kMaxDepth)
        return parsing.refuse(fmt::format("expected at most {} nested elements", kMaxDepth));
    XmlElement element;
    element.name = name;
    element.line = XML_GetCurrentLineNumber(parsing.parser);
    for (; *attributes; attributes += 2)
        element.attributes.emplace_back(attributes[0], attributes[1]);
    if (element.name == "AppendedData" && parsing.open.size() == 1) {
        parsing.appendedEncoding = element.attribute("encoding");
        parsing.appendedTagEnd = static_cast<std::uint64_t>(
            XML_GetCurrentByteIndex(parsing.parser) + XML_GetCurrentByteCount(parsing.parser));
        XML_StopParser(parsing.parser, XML_FALSE);
        return;
    }
    const bool text = !element.has("format") || element.attribute("format") == "ascii";
    const bool numbers = text && element.name == "DataArray";
    const VtkType* type = numbers ? vtkXmlType(element.attribute("type")) : nullptr;
    parsing.open.push_back({std::move(element), type, ""});
}

void endWord(Open& open) {
    if (open.numbers && open.element.notNumber.empty() && !open.word.empty() &&
        !isVtkNumber(open.numbers->type, open.word))
        open.element.notNumber = open.word;
    if (open.numbers && open.element.firstWord.empty()) open.element.firstWord = open.word;
    open.word.clear();
}

void close(Parsing& parsing) {
    endWord(parsing.open.back());
    XmlElement done = std::move(parsing.open.back().element);
    parsing.open.pop_back();
    if (parsing.open.empty())
        parsing.root = std::move(done);
    else
        parsing.open.back().element.children.push_back(std::move(done));
}

void end(void* user, const XML_Char*) {
    auto& parsing = *static_cast<Parsing*>(user);
    if (!parsing.open.empty()) close(parsing);
}

void characterData(void* user, const XML_Char* characters, int length) {
    auto& parsing = *static_cast<Parsing*>(user);
    if (parsing.open.empty()) return;
    Open& open = parsing.open.back();
    XmlElement& element = open.element;
    for (int i = 0; i < length; ++i) {
        if (blank(characters[i])) {
            endWord(open);
            continue;
        }
        if (element.characters++ == 0)
            element.textAt =
                static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parsing.parser) + i);
        element.words += open.word.empty();
        if (open.word.size() < kMaxXmlWord) open.word += characters[i];
    }
}

void doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    static_cast<Parsing*>(user)->refuse("expected no document type declaration");
}

// To the end of the file, or to its appended data. Throws FileError.
void parse(Parsing& parsing, const std::filesystem::path& path, std::ifstream& file) {
    XML_Parser parser = parsing.parser;
    std::string buffer(std::size_t{1} << 16, '\0');
    std::uint64_t given = 0;
    for (bool more = true; more;) {
        file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        more = file.good();
        const auto status =
            XML_Parse(parser, buffer.data(), static_cast<int>(file.gcount()), !more);
        if (parsing.appendedTagEnd != 0) break;
        const std::string place = fmt::format("line {}", XML_GetCurrentLineNumber(parser));
        if (status == XML_STATUS_OK) {
            given += static_cast<std::uint64_t>(file.gcount());
            const auto seen =
                static_cast<std::uint64_t>(std::max<XML_Index>(XML_GetCurrentByteIndex(parser), 0));
            if (given - seen > kMaxTokenBytes)
                failVtk(path, place, "expected at most 1 MiB in a tag or a comment");
            continue;
        }
        if (!parsing.refusal.empty()) failVtk(path, place, parsing.refusal);
        failVtk(path, place,
                fmt::format("expected well-formed XML, but: {}",
                            XML_ErrorString(XML_GetErrorCode(parser))));
    }
}

// Where the appended values begin: after blanks and one '_'.
std::uint64_t afterUnderscore(const std::filesystem::path& path, std::ifstream& file,
                              std::uint64_t at) {
    file.clear();
    file.seekg(static_cast<std::streamoff>(at));
    for (char c = 0; file.get(c);) {
        ++at;
        if (c == '_') return at;
        if (!blank(c)) break;
    }
    failVtk(path, "AppendedData", "expected '_' before its values, but there is none");
}

}  // namespace

std::string_view XmlElement::attribute(std::string_view wanted) const {
    for (const auto& [key, value] : attributes) {
        if (key != wanted) continue;
        std::string_view trimmed = value;
        while (!trimmed.empty() && blank(trimmed.front())) trimmed.remove_prefix(1);
        while (!trimmed.empty() && blank(trimmed.back())) trimmed.remove_suffix(1);
        return trimmed;
    }
    return "";
}

bool XmlElement::has(std::string_view wanted) const {
    return std::ranges::any_of(attributes, [&](const auto& a) { return a.first == wanted; });
}

XmlFile readXml(const std::filesystem::path& path) {
    XmlSoFar read = readXmlSoFar(path);
    if (!read.flaw.empty()) throw FileError(read.flaw);
    return std::move(read.file);
}

XmlSoFar readXmlSoFar(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) failVtk(path, "", "expected a file that can be read");
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
        XML_ParserCreate(nullptr), &XML_ParserFree);
    if (!parser) throw std::bad_alloc();
    Parsing parsing{parser.get(), {}, {}, 0, "", 0, ""};
    XML_SetUserData(parser.get(), &parsing);
    XML_SetElementHandler(parser.get(), start, end);
    XML_SetCharacterDataHandler(parser.get(), characterData);
    XML_SetStartDoctypeDeclHandler(parser.get(), doctype);

    XmlSoFar result{{path, {}, std::filesystem::file_size(path), 0, ""}, ""};
    XmlFile& read = result.file;
    try {
        parse(parsing, path, file);
        read.appendedEncoding = std::move(parsing.appendedEncoding);
        if (parsing.appendedTagEnd != 0) {
            if (read.appendedEncoding != "raw" && read.appendedEncoding != "base64")
                failVtk(path, "AppendedData",
                        fmt::format("expected the encoding raw or base64, found \"{}\"",
                                    read.appendedEncoding));
            read.appendedAt = afterUnderscore(path, file, parsing.appendedTagEnd);
        }
    } catch (const FileError& flaw) {
        result.flaw = flaw.what();
        // What has not ended may miss anything, but for the root and the grid around the rest.
        while (parsing.open.size() > 2) parsing.open.pop_back();
    }
    while (!parsing.open.empty()) close(parsing);  // those around the appended data
    read.root = std::move(parsing.root);
    return result;
}

}  // namespace timeseries
