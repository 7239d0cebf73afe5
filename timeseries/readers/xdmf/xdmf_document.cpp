#include "timeseries/readers/xdmf/xdmf_document.h"

#include <fmt/format.h>
#include <libxml/parser.h>
#include <libxml/tree.h>
#include <libxml/xpath.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <mutex>

#include "timeseries/readers/reader.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

constexpr std::size_t kMostReferences = 32;       // one to another
constexpr unsigned long kMostSteps = 1UL << 28;   // of all XPaths together: about two seconds
constexpr std::uintmax_t kMostBytes = 1UL << 28;  // of a file that is to say where values are

std::string own(xmlChar* text) {
    if (!text) return "";
    std::string copy(reinterpret_cast<const char*>(text));
    xmlFree(text);
    return copy;
}

std::string trimmed(const std::string& text) {
    constexpr const char* kBlank = " \t\r\n";
    const auto first = text.find_first_not_of(kBlank);
    if (first == text.npos) return "";
    return text.substr(first, text.find_last_not_of(kBlank) + 1 - first);
}

bool isNamed(const xmlNode* node, std::string_view name) {
    return node->type == XML_ELEMENT_NODE && reinterpret_cast<const char*>(node->name) == name;
}

// Texts come from the file, or from the library, which cites it: whatever they hold, one line that
// can be read.
std::string told(std::string_view what) {
    constexpr std::size_t kLongest = 500;
    return oneLine(what.substr(0, kLongest));
}

std::string textOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string text;
    std::error_code ignored;
    if (std::filesystem::file_size(path, ignored) <= kMostBytes)
        text.assign(std::istreambuf_iterator<char>(file), {});
    else
        throw FileError(
            fmt::format("{}: expected at most {} bytes of XML", path.string(), kMostBytes));
    if (file.bad() || !file.is_open())
        throw FileError(fmt::format("{}: expected a file that can be read", path.string()));
    return text;
}

// Its sentences are told by whoever asked; on the terminal they would stand beside them.
void keepSilent(void*, xmlErrorPtr) {}

}  // namespace

std::string XdmfElement::name() const { return reinterpret_cast<const char*>(node_->name); }

std::string XdmfElement::attribute(const char* name) const {
    return trimmed(own(xmlGetNoNsProp(node_, reinterpret_cast<const xmlChar*>(name))));
}

std::string XdmfElement::text() const {
    std::string all;
    for (xmlNode* inside = node_->children; inside; inside = inside->next)
        if (inside->type == XML_TEXT_NODE || inside->type == XML_CDATA_SECTION_NODE)
            all += reinterpret_cast<const char*>(inside->content);
    return trimmed(all);
}

long XdmfElement::line() const { return xmlGetLineNo(node_); }

XdmfDocument::XdmfDocument(const std::filesystem::path& path) : path_(path) {
    static std::once_flag once;
    std::call_once(once, [] {
        xmlInitParser();
        // Whoever wrote a file does not choose what else is opened.
        xmlSetExternalEntityLoader([](const char*, const char*,
                                      xmlParserCtxtPtr) -> xmlParserInputPtr { return nullptr; });
    });
    const std::string text = textOf(path);
    const std::unique_ptr<xmlParserCtxt, decltype(&xmlFreeParserCtxt)> parser(xmlNewParserCtxt(),
                                                                              &xmlFreeParserCtxt);
    if (!parser) throw std::bad_alloc();
    // The file's own entities, within the library's bounds.
    document_ = {xmlCtxtReadMemory(parser.get(), text.data(), static_cast<int>(text.size()),
                                   nullptr, nullptr,
                                   XML_PARSE_NOENT | XML_PARSE_NONET | XML_PARSE_NOERROR |
                                       XML_PARSE_NOWARNING | XML_PARSE_BIG_LINES),
                 &xmlFreeDoc};
    if (!document_) {
        const xmlError* const error = xmlCtxtGetLastError(parser.get());
        const std::string why =
            error && error->message ? told(trimmed(error->message)) : "it is not";
        throw FileError(fmt::format("{}: line {}: expected well-formed XML, but: {}", path.string(),
                                    error ? error->line : 1, why));
    }
    paths_ = {xmlXPathNewContext(document_.get()), &xmlXPathFreeContext};
    if (!paths_) throw std::bad_alloc();
    paths_->opLimit = kMostSteps;
    paths_->error = keepSilent;
    if (!root().exists() || root().name() != "Xdmf")
        throw FileError(fmt::format("{}: expected the element Xdmf", path.string()));
}

XdmfElement XdmfDocument::root() const {
    return XdmfElement(xmlDocGetRootElement(document_.get()));
}

void XdmfDocument::fail(const XdmfElement& at, std::string_view what) const {
    throw FileError(
        fmt::format("{}: line {}: {}", path_.string(), at.exists() ? at.line() : 1, told(what)));
}

std::vector<_xmlNode*> XdmfDocument::found(const XdmfElement& by,
                                           const std::string& expression) const {
    if (const auto known = found_.find(expression); known != found_.end()) return known->second;
    paths_->node = by.node();
    const std::unique_ptr<xmlXPathObject, decltype(&xmlXPathFreeObject)> result(
        xmlXPathEvalExpression(reinterpret_cast<const xmlChar*>(expression.c_str()), paths_.get()),
        &xmlXPathFreeObject);
    if (!result || result->type != XPATH_NODESET)
        fail(by, fmt::format("expected the path of an element, found '{}'", expression));
    std::vector<_xmlNode*> nodes;
    for (int i = 0; result->nodesetval && i < result->nodesetval->nodeNr; ++i)
        if (result->nodesetval->nodeTab[i]->type == XML_ELEMENT_NODE)
            nodes.push_back(result->nodesetval->nodeTab[i]);
    if (nodes.empty()) fail(by, fmt::format("expected an element at '{}', found none", expression));
    if (expression.starts_with('/')) found_[expression] = nodes;
    return nodes;
}

XdmfElement XdmfDocument::referred(XdmfElement from) const {
    for (std::size_t i = 0; i < kMostReferences; ++i) {
        const std::string reference = from.attribute("Reference");
        if (reference.empty()) return from;
        from = XdmfElement(found(from, reference == "XML" ? from.text() : reference).front());
    }
    fail(from, "expected references that end");
}

void XdmfDocument::add(const XdmfElement& from, std::string_view name,
                       std::vector<XdmfElement>& children) const {
    for (xmlNode* inside = from.node()->children; inside; inside = inside->next) {
        if (isNamed(inside, name)) children.push_back(referred(XdmfElement(inside)));
        if (!isNamed(inside, "include")) continue;
        // XInclude, of parts of the same file.
        const XdmfElement inclusion(inside);
        if (const std::string file = inclusion.attribute("href"); !file.empty())
            fail(inclusion, fmt::format("expected all in one file, found that it includes '{}', "
                                        "which is not read",
                                        file));
        std::string expression = inclusion.attribute("xpointer");
        constexpr std::string_view kScheme = "xpointer(";
        if (expression.starts_with(kScheme) && expression.ends_with(')'))
            expression = expression.substr(kScheme.size(), expression.size() - kScheme.size() - 1);
        for (xmlNode* node : found(inclusion, expression))
            if (isNamed(node, name)) children.push_back(referred(XdmfElement(node)));
    }
}

std::vector<XdmfElement> XdmfDocument::children(const XdmfElement& of,
                                                std::string_view name) const {
    std::vector<XdmfElement> all;
    add(of, name, all);
    return all;
}

XdmfElement XdmfDocument::child(const XdmfElement& of, std::string_view name) const {
    const auto all = children(of, name);
    return all.empty() ? XdmfElement() : all.front();
}

}  // namespace timeseries
