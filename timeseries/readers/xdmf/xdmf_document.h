// The elements of an XDMF file, by libxml2: entities that the file declares, inclusions from itself
// and references are followed. "XDMF Model and Format", www.xdmf.org.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct _xmlDoc;
struct _xmlNode;
struct _xmlXPathContext;

namespace timeseries {

// Of a document, which must outlive it.
class XdmfElement {
 public:
    XdmfElement() = default;
    explicit XdmfElement(_xmlNode* node) : node_(node) {}

    bool exists() const { return node_ != nullptr; }
    std::string name() const;
    // Without blanks around it; "" when there is none.
    std::string attribute(const char* name) const;
    // What stands directly inside, without blanks around it.
    std::string text() const;
    long line() const;
    _xmlNode* node() const { return node_; }

 private:
    _xmlNode* node_ = nullptr;
};

class XdmfDocument {
 public:
    // Throws FileError.
    explicit XdmfDocument(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    XdmfElement root() const;
    // Those of that name directly inside, in their order, each the one that it refers to, if it
    // does. Throw FileError when that is not there.
    std::vector<XdmfElement> children(const XdmfElement& of, std::string_view name) const;
    // The first; none that exists where there is none.
    XdmfElement child(const XdmfElement& of, std::string_view name) const;

    // "path: line 12: what".
    [[noreturn]] void fail(const XdmfElement& at, std::string_view what) const;

 private:
    std::vector<_xmlNode*> found(const XdmfElement& by, const std::string& expression) const;
    XdmfElement referred(XdmfElement from) const;
    void add(const XdmfElement& from, std::string_view name,
             std::vector<XdmfElement>& children) const;

    std::filesystem::path path_;
    std::shared_ptr<_xmlDoc> document_;
    std::shared_ptr<_xmlXPathContext> paths_;
    mutable std::map<std::string, std::vector<_xmlNode*>> found_;  // by XPath
};

}  // namespace timeseries
