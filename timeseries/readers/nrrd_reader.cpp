#include "timeseries/readers/nrrd_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "timeseries/readers/nrrd_axes.h"
#include "timeseries/readers/nrrd_stream.h"
#include "timeseries/readers/nrrd_times.h"

namespace timeseries {
namespace {

// Values read at a time when they have to be turned.
constexpr std::uint64_t kTurnCount = 1 << 15;

std::string storedAs(const NrrdHeader& header) {
    std::string text(typeName(header.type));
    if (header.swapped) text += " of the other byte order";
    switch (header.encoding) {
        case NrrdEncoding::Raw:
            return text;
        case NrrdEncoding::Gzip:
            return text + ", gzip";
        case NrrdEncoding::Bzip2:
            return text + ", bzip2";
        case NrrdEncoding::Ascii:
            return text + ", text";
    }
    return text;
}

class NrrdReader final : public Reader {
 public:
    explicit NrrdReader(const std::filesystem::path& path)
        : path_(path), header_(readNrrdHeader(path)) {
        std::vector<std::string> notes;
        const NrrdRoles roles = rolesOf(header_, notes);
        NrrdPlacing placing = placingOf(header_, roles, notes);
        layout_ = placing.layout;
        NrrdPieces pieces = piecesOf(header_, notes);
        format_ = header_.magic + (header_.dataFile ? ", detached values" : "");

        Variable variable;
        variable.nameless = header_.content.empty();
        variable.name = variable.nameless ? path.stem().string() : header_.content;
        variable.longName = header_.keyValue("quantity");
        variable.units = header_.sampleUnits;
        for (const char* key : {"unit", "units"})
            if (variable.units.empty()) variable.units = header_.keyValue(key);
        variable.type = header_.type;
        variable.storedAs = storedAs(header_);
        variable.grid =
            std::make_shared<const Grid>(std::move(placing.axes), std::move(placing.frame));
        variable.time = std::make_shared<const TimeAxis>(nrrdTimes(header_, roles, notes));
        variable.notes = std::move(notes);
        variables_.push_back(std::move(variable));
        stream_ = std::make_unique<NrrdStream>(header_, std::move(pieces));
    }

    std::string format() const override { return format_; }
    std::span<const std::filesystem::path> files() const override { return {&path_, 1}; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t step) override;

 private:
    template <typename T>
    void fill(std::size_t step, std::vector<T>& values);
    template <typename T>
    void scatter(std::uint64_t first, std::span<const T> from, std::vector<T>& values) const;

    std::filesystem::path path_;
    NrrdHeader header_;
    NrrdLayout layout_;
    std::string format_;
    std::vector<Variable> variables_;
    std::unique_ptr<NrrdStream> stream_;
};

// Puts points `first` and on, counted in the file's order, where the grid has them.
template <typename T>
void NrrdReader::scatter(std::uint64_t first, std::span<const T> from,
                         std::vector<T>& values) const {
    const auto& [nx, ny, nz] = layout_.size;
    const auto& [sx, sy, sz] = layout_.stride;
    std::uint64_t x = first % nx, y = first / nx % ny, z = first / nx / ny;
    for (const T value : from) {
        values[x * sx + y * sy + z * sz] = value;
        if (++x < nx) continue;
        x = 0;
        if (++y < ny) continue;
        y = 0;
        ++z;
    }
}

template <typename T>
void NrrdReader::fill(std::size_t step, std::vector<T>& values) {
    values.resize(layout_.inner * layout_.outer);
    std::vector<T> part(layout_.turned ? std::min(kTurnCount, layout_.inner) : 0);
    for (std::uint64_t outer = 0; outer < layout_.outer; ++outer) {
        const std::uint64_t at = (outer * layout_.steps + step) * layout_.inner;
        const std::uint64_t point = outer * layout_.inner;
        if (!layout_.turned) {
            stream_->read(at, layout_.inner, values.data() + point);
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

Field NrrdReader::read(std::size_t variable, std::size_t step) {
    Field field;
    field.grid = variables_[variable].grid;
    field.values = valuesOf(header_.type);
    std::visit([&](auto& values) { fill(step, values); }, field.values);
    return field;
}

}  // namespace

std::unique_ptr<Reader> openNrrd(std::span<const std::filesystem::path> paths) {
    if (paths.size() > 1)
        throw FileError(fmt::format("{} and {}: expected one NRRD file, which holds all its steps",
                                    paths[0].string(), paths[1].string()));
    return std::make_unique<NrrdReader>(paths[0]);
}

}  // namespace timeseries
