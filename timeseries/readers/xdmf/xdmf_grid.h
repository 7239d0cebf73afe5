// Where the points and cells of a step of an XDMF file lie.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/xdmf/xdmf_steps.h"

namespace timeseries {

// Everything here throws FileError.
class XdmfGrid {
 public:
    // One grid of any kind, or several whose cells name their corners, one behind the other. What
    // it is given must outlive it.
    XdmfGrid(const XdmfDocument& document, XdmfItems& items, const XdmfStep& step);

    // The same for steps whose points and cells are.
    static std::string sourceOf(const XdmfDocument& document, XdmfItems& items,
                                const XdmfStep& step);

    bool isUnstructured() const { return !shape_.isStructured; }
    struct Counts {
        std::uint64_t points, cells;
        std::uint64_t at(bool atPoints) const { return atPoints ? points : cells; }
    };
    const std::vector<Counts>& parts() const { return parts_; }
    std::shared_ptr<const Grid> at(bool atPoints);
    std::vector<std::string> notes() const;  // of the cells

 private:
    struct Shape {
        bool isStructured = false, hasPlaces = false;
        std::array<std::size_t, 3> size{1, 1, 1};  // points, x first
    };
    Shape shapeOf(const XdmfElement& topology) const;
    void addCells(const XdmfElement& topology, std::uint64_t points);
    void addMixed(const XdmfElement& topology, const std::vector<std::uint32_t>& stream);
    std::vector<std::uint32_t> idsOf(const XdmfElement& topology, std::uint64_t below);
    std::vector<glm::dvec3> placesOf(const XdmfElement& geometry);
    void readAxes(const XdmfElement& geometry);
    std::array<std::size_t, 3> sizeAt(bool atPoints) const;
    std::shared_ptr<const Grid> made(bool atPoints);

    const XdmfDocument& document_;
    XdmfItems& items_;
    XdmfElement first_;  // topology, for what is said of all
    Shape shape_;
    std::vector<Counts> parts_;
    std::vector<glm::dvec3> places_;                  // of a structured grid that has them
    std::array<std::vector<double>, 3> coordinates_;  // of one that has none
    UnstructuredGrid cells_;
    std::optional<UnstructuredShapes> shapes_;
    std::array<std::shared_ptr<const Grid>, 2> grids_;  // at cells, at points
};

}  // namespace timeseries
