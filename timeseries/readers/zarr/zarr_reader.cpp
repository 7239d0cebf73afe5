#include "timeseries/readers/zarr/zarr_reader.h"

#include <algorithm>
#include <map>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/netcdf/netcdf_reader.h"
#include "timeseries/readers/zarr/zarr_header.h"
#include "timeseries/readers/zarr/zarr_values.h"

namespace timeseries {
namespace {

class ZarrFile final : public CfFile {
 public:
    explicit ZarrFile(const std::filesystem::path& path)
        : CfFile(path), hierarchy_(zarrHierarchyOf(path)) {
        ZarrHeader all = zarrHeaderOf(hierarchy_);
        header_ = std::move(all.header);
        sources_ = std::move(all.sources);
        damaged_ = std::move(all.damaged);
    }

    std::span<const DamagedVariable> damaged() const override { return damaged_; }
    std::vector<std::filesystem::path> sources() const override {
        if (hierarchy_.store->isOneFile()) return {path_};
        return {};
    }
    std::string tooLarge(const NcVariable& variable, std::uint64_t points) const override;
    std::vector<Number> numbers(const NcVariable& variable) const override;
    void read(const NcVariable& variable, std::span<const std::size_t> start,
              std::span<const std::size_t> count, void* values) const override;

 private:
    const ZarrSource& sourceOf(const NcVariable& variable) const {
        return sources_[static_cast<std::size_t>(variable.id)];
    }
    ZarrValues& valuesOf(const NcVariable& variable) const;
    std::vector<Number> placesOf(const NcVariable& variable, std::uint64_t count) const;

    ZarrHierarchy hierarchy_;  // in which sources_ point
    std::vector<ZarrSource> sources_;
    std::vector<DamagedVariable> damaged_;
    mutable std::map<const ZarrArray*, ZarrValues> values_;  // of those that were read
};

ZarrValues& ZarrFile::valuesOf(const NcVariable& variable) const {
    const ZarrArray* const array = sourceOf(variable).array;
    return values_.try_emplace(array, *hierarchy_.store, *array).first->second;
}

std::string ZarrFile::tooLarge(const NcVariable& variable, std::uint64_t points) const {
    const ZarrArray* const array = sourceOf(variable).array;
    return array && array->flaw.empty() ? valuesOf(variable).tooLarge(points) : "";
}

std::vector<Number> ZarrFile::placesOf(const NcVariable& variable, std::uint64_t count) const {
    if (count > kMaxAxis) failAttribute(variable, "expected at most 2^24 points along an axis");
    const auto& [scale, offset] = sourceOf(variable).places;
    std::vector<Number> places;
    for (std::uint64_t i = 0; i < count; ++i)
        places.emplace_back(scale * static_cast<double>(i) + offset);
    return places;
}

// What coordinates are damaged costs the variables that need them alone.
std::vector<Number> ZarrFile::numbers(const NcVariable& variable) const {
    double points = 1;
    std::vector<std::size_t> start(variable.dimensions.size(), 0), lengths;
    for (const std::size_t d : variable.dimensions) {
        lengths.push_back(header_.dimensions[d].length);
        points *= static_cast<double>(lengths.back());
    }
    const auto count = static_cast<std::uint64_t>(std::min(points, 1e18));
    const ZarrArray* const array = sourceOf(variable).array;
    if (!array) return placesOf(variable, count);
    if (!array->flaw.empty()) failAttribute(variable, array->flaw);
    if (const std::string why = tooLarge(variable, count); !why.empty())
        failAttribute(variable, why);
    return withType(*variable.type, [&](auto t) {
        std::vector<decltype(t)> stored(count);
        try {
            read(variable, start, lengths, stored.data());
        } catch (const FileError& error) {
            throw AttributeError(error.what());
        }
        std::vector<Number> numbers;
        numbers.reserve(count);
        for (const auto value : stored) numbers.push_back(numberOf(value));
        return numbers;
    });
}

void ZarrFile::read(const NcVariable& variable, std::span<const std::size_t> start,
                    std::span<const std::size_t> count, void* values) const {
    const ZarrSource& source = sourceOf(variable);
    if (!source.array->flaw.empty()) failAttribute(variable, source.array->flaw);
    std::vector<std::size_t> from(start.begin(), start.end()), counts(count.begin(), count.end());
    if (source.channels) {
        const auto at = static_cast<std::ptrdiff_t>(*source.channels);
        from.insert(from.begin() + at, source.channel);
        counts.insert(counts.begin() + at, 1);
    }
    valuesOf(variable).read(from, counts, static_cast<std::byte*>(values));
}

}  // namespace

std::unique_ptr<Reader> openZarr(std::span<const std::filesystem::path> paths) {
    return openCf(
        paths, std::make_unique<ZarrFile>(paths[0]),
        [](const std::filesystem::path& path, bool) { return std::make_unique<ZarrFile>(path); });
}

}  // namespace timeseries
