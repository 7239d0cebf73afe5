// XDMF files as tests write them.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/files.h"

namespace tests::xdmf {

inline std::filesystem::path written(const std::string& domain, const std::string& before = "") {
    const auto path = testFolder() / "file.xdmf";
    writeBytes(path, "<?xml version=\"1.0\"?>\n" + before +
                         "<Xdmf Version=\"3.0\" "
                         "xmlns:xi=\"http://www.w3.org/2001/XInclude\">\n<Domain>\n" +
                         domain + "\n</Domain>\n</Xdmf>\n");
    return path;
}

inline std::string item(const std::string& dimensions, const std::string& text,
                        const std::string& attributes = "") {
    return "<DataItem Dimensions=\"" + dimensions + "\" " + attributes + ">" + text +
           "</DataItem>\n";
}
inline std::string inHdf(const std::string& dimensions, const std::string& array) {
    return item(dimensions, "\n  data.h5:/" + array + "\n", "Format=\"HDF\"");
}
inline std::string attribute(const std::string& name, const std::string& centre,
                             const std::string& of) {
    return "<Attribute Name=\"" + name + "\" Center=\"" + centre + "\">" + of + "</Attribute>\n";
}
inline std::string grid(const std::string& inside, const std::string& attributes = "") {
    return "<Grid " + attributes + ">\n" + inside + "</Grid>\n";
}
inline std::string inTime(const std::string& inside) {
    return grid(inside, "GridType=\"Collection\" CollectionType=\"Temporal\"");
}

// Of 3 x 2 x 1 steps of 10, 20 and 30 from 1, 2 and 3 on, as ParaView writes it.
inline const std::string kImage =
    "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"2 3 4\"/>\n"
    "<Geometry GeometryType=\"ORIGIN_DXDYDZ\">" +
    item("3", "3 2 1") + item("3", "30 20 10") + "</Geometry>\n";

inline std::string numbersTo(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(i) + " ";
    return text;
}

inline std::string slab(const std::string& which, const std::string& whole,
                        const std::string& count) {
    return "<DataItem ItemType=\"HyperSlab\" Dimensions=\"" + count + "\">" +
           item("3 4", which, "NumberType=\"Int\"") + whole + "</DataItem>";
}

}  // namespace tests::xdmf
