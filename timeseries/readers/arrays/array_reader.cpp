#include "timeseries/readers/arrays/array_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "timeseries/grid/pages.h"
#include "timeseries/readers/arrays/array_axes.h"
#include "timeseries/readers/arrays/array_stream.h"
#include "timeseries/readers/arrays/array_times.h"

namespace timeseries {
namespace {

// Values read at a time when they have to be turned.
constexpr std::uint64_t kTurnCount = 1 << 15;

std::string storedAs(const ArrayHeader& header) {
    std::string text(typeName(header.type));
    if (header.swapped) text += " of the other byte order";
    static constexpr std::array kEncodings{"", ", gzip", ", bzip2", ", text"};
    text += kEncodings[static_cast<std::size_t>(header.encoding)];
    if (const auto& scaling = header.scaling)
        text += fmt::format(", scale {}, offset {}", scaling->slope, scaling->offset);
    return text;
}

// "brain" of brain.nii.gz.
std::string nameOf(const std::filesystem::path& path) {
    const std::filesystem::path stem = path.stem();
    return (path.extension() == ".gz" ? stem.stem() : stem).string();
}

class ArrayReader final : public Reader {
 public:
    explicit ArrayReader(ArrayHeader header) : header_(std::move(header)) {
        std::vector<std::string> notes = header_.notes, notesOfPieces;
        const ArrayRoles roles = rolesOf(header_, notes);
        const ArrayLayout layout = layoutOf(header_, roles);
        // Before axes are made of a size that no file can hold.
        ArrayPieces pieces = piecesOf(header_, notesOfPieces);
        ArrayPlacing placing = placingOf(header_, roles, layout, notes);
        layout_ = placing.layout;
        notes.insert(notes.end(), notesOfPieces.begin(), notesOfPieces.end());
        Variable variable;
        variable.nameless = header_.name.empty();
        variable.name = variable.nameless ? nameOf(header_.path) : header_.name;
        variable.longName = header_.longName;
        variable.units = header_.units;
        variable.type = header_.scaling ? ValueType::F64 : header_.type;
        variable.storedAs = storedAs(header_);
        variable.categories = header_.categories;
        variable.grid =
            std::make_shared<const Grid>(std::move(placing.axes), std::move(placing.frame));
        variable.time = std::make_shared<const TimeAxis>(arrayTimes(header_, roles, notes));
        variable.notes = std::move(notes);
        variables_.push_back(std::move(variable));
        sources_ = pieces.paths;
        if (std::ranges::find(sources_, header_.path) == sources_.end())
            sources_.insert(sources_.begin(), header_.path);
        stream_ = std::make_unique<ArrayStream>(header_, std::move(pieces));
    }

    std::string format() const override { return header_.format; }
    std::span<const std::filesystem::path> files() const override { return {&header_.path, 1}; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t step) override;
    void readSlab(std::size_t variable, std::size_t step, const Slab& slab, Field& into) override;
    bool readsPlanes(std::size_t variable, std::size_t) override {
        return header_.encoding == ArrayEncoding::Raw && layout_.outer == 1 &&
               isOnePiece(variable, 2);
    }
    StepSources sources(std::size_t, std::size_t step) override { return {sources_, step}; }

 private:
    // Of a slab along this axis, in the file.
    bool isOnePiece(std::size_t variable, std::size_t axis) const {
        return !layout_.turned && pointsOf(variable, axis + 1) == points();
    }
    // Along the axes before this one.
    std::uint64_t pointsOf(std::size_t variable, std::size_t axes) const;
    std::uint64_t points() const { return layout_.inner * layout_.outer; }
    // Points [first, last) in the order of the grid. REQUIRES: all, where that is not the file's.
    void readValues(std::size_t step, std::uint64_t first, std::uint64_t last, Field& into);
    template <typename T>
    void fill(std::size_t step, std::uint64_t first, std::uint64_t last, std::vector<T>& values);
    template <typename T>
    void scatter(std::uint64_t first, std::span<const T> from, std::vector<T>& values) const;

    ArrayHeader header_;
    ArrayLayout layout_;
    std::vector<Variable> variables_;
    std::vector<std::filesystem::path> sources_;  // the header, and where else values lie
    std::unique_ptr<ArrayStream> stream_;
};

// Puts points `first` and on, counted in the file's order, where the grid has them.
template <typename T>
void ArrayReader::scatter(std::uint64_t first, std::span<const T> from,
                          std::vector<T>& values) const {
    const auto& [nx, ny, nz] = layout_.size;
    const auto& [sx, sy, sz] = layout_.stride;
    auto at = indicesOf(first, glm::vec<3, std::uint64_t>(nx, ny, nz));
    for (const T value : from) {
        values[at.x * sx + at.y * sy + at.z * sz] = value;
        if (++at.x < nx) continue;
        at.x = 0;
        if (++at.y < ny) continue;
        at.y = 0;
        ++at.z;
    }
}

template <typename T>
void ArrayReader::fill(std::size_t step, std::uint64_t first, std::uint64_t last,
                       std::vector<T>& values) {
    if (values.size() != last - first) {
        values.clear();
        resizePopulated(values, last - first);
    }
    std::vector<T> part(layout_.turned ? std::min(kTurnCount, layout_.inner) : 0);
    for (std::uint64_t outer = 0; outer < layout_.outer; ++outer) {
        const std::uint64_t at = (outer * layout_.steps + step) * layout_.inner;
        const std::uint64_t point = outer * layout_.inner;
        if (!layout_.turned) {
            const std::uint64_t from = std::max(point, first);
            const std::uint64_t to = std::min(point + layout_.inner, last);
            if (from < to)
                stream_->read(at + from - point, to - from, values.data() + from - first);
            continue;
        }
        for (std::uint64_t done = 0; done < layout_.inner; done += part.size()) {
            const std::uint64_t count = std::min<std::uint64_t>(part.size(), layout_.inner - done);
            stream_->read(at + done, count, part.data());
            scatter(point + done, std::span<const T>(part.data(), count), values);
        }
    }
}

template <std::size_t I = 0>
Values valuesOf(ValueType type) {
    if constexpr (I + 1 < std::variant_size_v<Values>)
        if (static_cast<std::size_t>(type) != I) return valuesOf<I + 1>(type);
    return Values(std::in_place_index<I>);
}

std::vector<double> scaled(const Values& stored, const ArrayHeader::Scaling& by) {
    std::vector<double> values;
    std::visit(
        [&](const auto& from) {
            values.reserve(from.size());
            for (const auto s : from)
                values.push_back(by.slope * static_cast<double>(s) + by.offset);
        },
        stored);
    return values;
}

void ArrayReader::readValues(std::size_t step, std::uint64_t first, std::uint64_t last,
                             Field& into) {
    into.categories = header_.categories;
    if (into.type() != header_.type) into.values = valuesOf(header_.type);
    std::visit([&](auto& values) { fill(step, first, last, values); }, into.values);
    if (header_.scaling) into.values = scaled(into.values, *header_.scaling);
}

Field ArrayReader::read(std::size_t variable, std::size_t step) {
    Field field;
    readValues(step, 0, points(), field);
    field.grid = variables_[variable].grid;
    return field;
}

std::uint64_t ArrayReader::pointsOf(std::size_t variable, std::size_t axes) const {
    const auto size = variables_[variable].grid->size();
    return std::accumulate(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(axes),
                           std::uint64_t{1}, std::multiplies());
}

void ArrayReader::readSlab(std::size_t variable, std::size_t step, const Slab& slab, Field& into) {
    if (!isOnePiece(variable, slab.axis)) return Reader::readSlab(variable, step, slab, into);
    const std::uint64_t inner = pointsOf(variable, slab.axis);
    readValues(step, slab.first * inner, (slab.first + slab.count) * inner, into);
}

}  // namespace

std::unique_ptr<Reader> openArray(ArrayHeader header) {
    return std::make_unique<ArrayReader>(std::move(header));
}

}  // namespace timeseries
