// The header of a legacy VTK file: its lines, with the values skipped ("VTK File Formats", Kitware,
// "Simple legacy formats", and vtkDataReader).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "timeseries/readers/vtk/vtk_legacy_cells.h"
#include "timeseries/readers/vtk/vtk_number.h"
#include "timeseries/readers/vtk/vtk_text.h"

namespace timeseries {
namespace {

struct Attribute {
    std::string_view word;
    std::uint64_t components;  // 0 where the file says how many
    VtkKeyword keyword;
};
constexpr std::array kAttributes{
    Attribute{"scalars", 1, VtkKeyword::Scalars},
    Attribute{"color_scalars", 0, VtkKeyword::Scalars},
    Attribute{"vectors", 3, VtkKeyword::Vectors},
    Attribute{"normals", 3, VtkKeyword::Normals},
    Attribute{"tensors", 9, VtkKeyword::Tensors},
    Attribute{"tensors6", 6, VtkKeyword::Tensors},
    Attribute{"texture_coordinates", 0, VtkKeyword::TextureCoordinates},
    Attribute{"global_ids", 1, VtkKeyword::Ids},
    Attribute{"pedigree_ids", 1, VtkKeyword::Ids},
    Attribute{"edge_flags", 1, VtkKeyword::Ids},
};

class LegacyHeader {
 public:
    explicit LegacyHeader(const std::filesystem::path& path) : text_(path) { header_.path = path; }

    VtkHeader read() {
        readStart();
        for (std::string word = text_.lowerWord(); !word.empty(); word = text_.lowerWord())
            readSection(word);
        finishPolygons();
        if (!sized_) text_.fail(fmt::format("expected {}, but the file ends", wanted()));
        if (header_.kind == VtkKind::LegacyStructured && !placed_)
            text_.fail("expected POINTS, but the file ends");
        if (header_.kind == VtkKind::LegacyRectilinear)
            for (std::size_t i = 0; i < 3; ++i)
                if (header_.coordinates[i].size() != header_.size(VtkPlace::Points)[i])
                    text_.fail(fmt::format("expected {}_COORDINATES, but the file ends", "XYZ"[i]));
        return std::move(header_);
    }

 private:
    void readStart();
    void readSection(const std::string& word);
    void readDataset();
    void readCells(const std::string& word);
    void finishPolygons();
    void takeCells();
    std::string wanted() const {
        if (!cells_) return "DIMENSIONS";
        const std::string missing = cells_->missing();
        return missing.empty() ? "VERTICES, LINES or POLYGONS" : missing;
    }
    void readDimensions();
    void readCoordinates(std::size_t axis);
    void skipPoints();
    void readAttribute(const std::string& word);
    void readField();
    void readFieldArray();
    void beginAttributes(VtkPlace place);
    void skipLookupTable();
    void countArray();
    const VtkType* readType();
    // Of the type that was read last.
    void skipValues(const VtkType* type, std::uint64_t values);
    std::array<double, 3> three(std::string_view what);
    // The values come next.
    void add(std::string name, const VtkType* type, std::uint64_t components, VtkKeyword keyword);

    VtkText text_;
    VtkHeader header_;
    bool sized_ = false, placed_ = false;
    bool endsApart_ = false;  // of cells' lists: from version 5 on
    std::optional<VtkLegacyCells> cells_;
    std::optional<VtkPlace> place_;  // once POINT_DATA or CELL_DATA has come
    std::set<std::pair<VtkPlace, std::string>> names_;
    std::string typeName_;
    std::uint64_t arrays_ = 0;
};

void LegacyHeader::readStart() {
    const std::string magic = text_.line();
    if (!magic.starts_with("# vtk DataFile Version "))
        text_.fail("expected \"# vtk DataFile Version\" and a number");
    const std::string_view version = std::string_view(magic).substr(23);
    if (version.empty() || version[0] < '1' || version[0] > '5')
        text_.fail(fmt::format("expected a version from 1.0 to 5.1, found \"{}\"", version));
    endsApart_ = version[0] == '5';
    text_.line();  // the title
    const std::string coding = text_.lowerWord();
    if (coding != "ascii" && coding != "binary")
        text_.fail(fmt::format("expected ASCII or BINARY, found \"{}\"", coding));
    text_.setBinary(coding == "binary");
}

void LegacyHeader::readSection(const std::string& word) {
    if (word == "dataset") return readDataset();
    if (word == "field") return readField();
    if (word == "metadata") return text_.skipParagraph();
    if (header_.format.empty()) text_.fail(fmt::format("expected DATASET, found \"{}\"", word));
    if (word == "point_data" || word == "cell_data") finishPolygons();
    if (cells_ && !place_ && !sized_) return readCells(word);
    if (word == "dimensions" && !cells_) return readDimensions();
    if (!place_ && header_.kind == VtkKind::LegacyPoints) {
        if (word == "origin") return void(header_.origin = three("an origin"));
        if (word == "spacing" || word == "aspect_ratio")
            return void(header_.spacing = three("a spacing"));
    }
    if (!sized_) text_.fail(fmt::format("expected DIMENSIONS, found \"{}\"", word));
    if (!place_ && header_.kind == VtkKind::LegacyRectilinear && word.ends_with("_coordinates") &&
        word.size() == 13 && word[0] >= 'x' && word[0] <= 'z')
        return readCoordinates(static_cast<std::size_t>(word[0] - 'x'));
    if (!place_ && header_.kind == VtkKind::LegacyStructured && word == "points")
        return skipPoints();
    if (word == "point_data") return beginAttributes(VtkPlace::Points);
    if (word == "cell_data") return beginAttributes(VtkPlace::Cells);
    if (!place_) text_.fail(fmt::format("expected POINT_DATA or CELL_DATA, found \"{}\"", word));
    readAttribute(word);
}

void LegacyHeader::readDataset() {
    const std::string kind = text_.lowerWord();
    if (!header_.format.empty()) text_.fail("expected one DATASET, found another");
    if (kind == "structured_points") {
        header_.kind = VtkKind::LegacyPoints;
        header_.format = "VTK structured points (legacy)";
    } else if (kind == "rectilinear_grid") {
        header_.kind = VtkKind::LegacyRectilinear;
        header_.format = "VTK rectilinear grid (legacy)";
    } else if (kind == "structured_grid") {
        header_.kind = VtkKind::LegacyStructured;
        header_.format = "VTK structured grid (legacy)";
    } else if (kind == "unstructured_grid") {
        header_.kind = VtkKind::LegacyUnstructured;
        header_.format = "VTK unstructured grid (legacy)";
        cells_.emplace(VtkLegacyCells::Kind::Unstructured, endsApart_);
    } else if (kind == "polydata") {
        header_.kind = VtkKind::LegacyPolygons;
        header_.format = "VTK polygons (legacy)";
        cells_.emplace(VtkLegacyCells::Kind::Polygons, endsApart_);
    } else {
        text_.fail(
            fmt::format("expected DATASET STRUCTURED_POINTS, RECTILINEAR_GRID, STRUCTURED_GRID, "
                        "UNSTRUCTURED_GRID or POLYDATA, found \"{}\"",
                        kind));
    }
}

void LegacyHeader::readCells(const std::string& word) {
    if (!cells_->read(text_, word))
        text_.fail(fmt::format("expected {}, found \"{}\"", wanted(), word));
    if (header_.kind == VtkKind::LegacyUnstructured && cells_->missing().empty()) takeCells();
}

// Which of their lists there are, no word before tells.
void LegacyHeader::finishPolygons() {
    if (header_.kind == VtkKind::LegacyPolygons && !sized_ && cells_->missing().empty())
        takeCells();
}

void LegacyHeader::takeCells() {
    header_.unstructured = cells_->take(text_);
    VtkPiece whole;
    whole.points = header_.unstructured.points.size();
    whole.cells = header_.unstructured.types.size();
    header_.pieces = {whole};
    checkVtkCount(header_, text_.place());
    sized_ = true;
}

void LegacyHeader::readDimensions() {
    if (sized_) text_.fail("expected one DIMENSIONS, found another");
    for (auto& [first, last] : header_.extent) {
        first = 0;
        last = static_cast<std::int64_t>(text_.count("a number of points")) - 1;
    }
    checkVtkExtent(header_, text_.place());
    sized_ = true;
}

std::array<double, 3> LegacyHeader::three(std::string_view what) {
    std::array<double, 3> numbers{};
    for (double& number : numbers) number = text_.number(what);
    return numbers;
}

const VtkType* LegacyHeader::readType() {
    typeName_ = text_.lowerWord();
    return vtkLegacyType(typeName_);
}

void LegacyHeader::readCoordinates(std::size_t axis) {
    const std::uint64_t count = text_.count("a number of coordinates");
    if (count != header_.size(VtkPlace::Points)[axis])
        text_.fail(fmt::format("expected {} coordinates, found {}",
                               header_.size(VtkPlace::Points)[axis], count));
    const VtkType* type = readType();
    if (!type) text_.fail(fmt::format("expected a type of number, found \"{}\"", typeName_));
    header_.coordinates[axis] = text_.numbers(*type, count);
}

// VTK reads them.
void LegacyHeader::skipPoints() {
    const std::uint64_t count = text_.count("a number of points"),
                        all = header_.count(VtkPlace::Points);
    if (placed_ || count != all)
        text_.fail(fmt::format("expected {} points once, found {}", all, count));
    const VtkType* type = readType();
    if (!type) text_.fail(fmt::format("expected a type of number, found \"{}\"", typeName_));
    text_.skipNumbers(*type, 3 * count);
    placed_ = true;
}

void LegacyHeader::beginAttributes(VtkPlace place) {
    const std::uint64_t count = text_.count("a number of points or cells");
    if (count != header_.count(place))
        text_.fail(fmt::format("expected {} {}, found {}", header_.count(place),
                               place == VtkPlace::Points ? "points" : "cells", count));
    place_ = place;
}

void LegacyHeader::countArray() {
    if (++arrays_ > kMaxVtkArrays)
        text_.fail(fmt::format("expected at most {} arrays, found more", kMaxVtkArrays));
}

void LegacyHeader::add(std::string name, const VtkType* type, std::uint64_t components,
                       VtkKeyword keyword) {
    countArray();
    if (components < 1 || components > kMaxVtkComponents)
        text_.fail(
            fmt::format("expected 1 to {} components, found {}", kMaxVtkComponents, components));
    const std::uint64_t values = header_.count(*place_) * components;
    if (!names_.emplace(*place_, name).second)
        text_.fail(fmt::format("expected names that differ, found '{}' again", name));
    skipValues(type, values);
    if (!type)
        header_.passedOver.push_back(fmt::format("'{}' has the type {}", name, typeName_));
    else if (isVtkGhostName(name))
        header_.ghosts[static_cast<std::size_t>(*place_)] = true;
    else
        header_.arrays.push_back({std::move(name), *place_, type->type, components, keyword});
}

void LegacyHeader::skipValues(const VtkType* type, std::uint64_t values) {
    if (type && typeName_.empty())
        text_.skipBytesOrWords(values, values);
    else if (type)
        text_.skipNumbers(*type, values);
    else if (typeName_ == "bit")
        text_.skipBytesOrWords((values + 7) / 8, values);
    else if (typeName_ == "string" || typeName_ == "utf8_string")
        text_.skipStrings(values);
    else
        text_.fail(fmt::format("expected a type of number, found \"{}\"", typeName_));
}

void LegacyHeader::skipLookupTable() {
    text_.name();
    const std::uint64_t colors = text_.count("a number of colours");
    text_.skipBytesOrWords(colors * 4, colors * 4);
}

void LegacyHeader::readAttribute(const std::string& word) {
    if (word == "lookup_table") return skipLookupTable();
    const auto attribute = std::ranges::find(kAttributes, word, &Attribute::word);
    if (attribute == kAttributes.end())
        text_.fail(fmt::format("expected an attribute such as SCALARS, found \"{}\"", word));
    std::string name = text_.name();
    std::uint64_t components = attribute->components;
    if (components == 0) components = text_.count("a number of components");
    if (word == "color_scalars") {
        typeName_.clear();  // bytes, but numbers from 0 to 1 in text
        return add(std::move(name), vtkLegacyType("unsigned_char"), components, attribute->keyword);
    }
    const VtkType* type = readType();
    if (word == "scalars") {
        std::string next = text_.lowerWord();
        if (const auto number = vtkNumber<std::uint16_t>(next)) {
            components = *number;
            next = text_.lowerWord();
        }
        if (next != "lookup_table")
            text_.fail(fmt::format("expected LOOKUP_TABLE, found \"{}\"", next));
        text_.name();
    }
    add(std::move(name), type, components, attribute->keyword);
}

void LegacyHeader::readField() {
    text_.name();
    header_.fieldOutside |= !place_;
    const std::uint64_t arrays = text_.count("a number of arrays");
    for (std::uint64_t i = 0; i < arrays; ++i) readFieldArray();
}

void LegacyHeader::readFieldArray() {
    std::string name = text_.word();
    if (name == "METADATA") {  // of the array before
        text_.skipParagraph();
        name = text_.word();
    }
    if (name.empty()) text_.fail("expected the name of an array, but the file ends");
    if (name == "NULL_ARRAY") return;
    name = text_.decoded(name);
    const std::uint64_t components = text_.count("a number of components");
    const std::uint64_t tuples = text_.count("a number of tuples");
    const VtkType* type = readType();
    if (components > kMaxVtkComponents)
        text_.fail(
            fmt::format("expected at most {} components, found {}", kMaxVtkComponents, components));
    if (place_ && tuples == header_.count(*place_))
        return add(std::move(name), type, components, VtkKeyword::Field);

    countArray();
    const std::uint64_t values = tuples * components;
    if (place_) header_.passedOver.push_back(fmt::format("'{}' has {} tuples", name, tuples));
    const auto time = place_ || values != 1 || !type ? std::nullopt : vtkTimeName(name);
    if (!time) return skipValues(type, values);
    const double number = text_.numbers(*type, 1)[0];
    if (std::isfinite(number) && (!header_.time || *time == "time"))
        header_.time = VtkTime{*time, number};
}

}  // namespace

VtkHeader readVtkLegacyHeader(const std::filesystem::path& path) {
    return LegacyHeader(path).read();
}

}  // namespace timeseries
