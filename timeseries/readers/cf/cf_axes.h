// Which dimension of a variable is longitude, latitude, height, time: by the attributes of its
// coordinate variable, then by names, then by position (CF 1.10, chapters 4 and 5). Or a list of
// places one after another, as meshes have it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "timeseries/readers/cf/cf_axis_kinds.h"
#include "timeseries/readers/cf/netcdf_header.h"

namespace timeseries {

// What WRF and MPAS call the texts of their times.
inline constexpr std::array<std::string_view, 2> kTextTimes{"Times", "xtime"};

// Positions in NcVariable::dimensions.
struct Roles {
    std::optional<std::size_t> x, y, z, t;
    std::vector<std::size_t> extra;   // longer than 1 and none of these
    std::optional<std::size_t> list;  // of places one after another: cells or nodes of a mesh
    int spatial() const { return int{x.has_value()} + int{y.has_value()} + int{z.has_value()}; }
};

// What the dimensions of a file are, found once from all of its variables: what is time for one of
// them is no height for another, and a coordinate that one of them names is that of all.
class FileAxes {
 public:
    // `fields`: the variables that may be drawn. The header must outlive this.
    FileAxes(const NcHeader& header, std::span<const NcVariable* const> fields);

    // The coordinate variable of a dimension: one-dimensional, numeric, of its name, else named by
    // the attribute `coordinates`, the variable's own before others'; of a forecast's times those
    // that it is for, where there are such. Null if none, or several.
    const NcVariable* coordinateOf(const NcVariable& variable, std::size_t position) const;
    // What has texts along a dimension that may be its times: of its name, else as models call
    // them. Null if none.
    const NcVariable* textsAlong(const NcVariable& variable, std::size_t position) const;
    Roles rolesOf(const NcVariable& variable) const;
    // Whether anything but where it stands among its dimensions says so.
    bool isToldAsTime(const NcVariable& variable, std::size_t position) const;

 private:
    struct Dimension {
        std::vector<const NcVariable*> coordinates;  // named by any variable
        std::vector<const NcVariable*> times;        // in units of time since a date
        bool list = false;
        bool time = false;  // by its position in a variable of four dimensions
    };
    struct Claim;
    const NcVariable* find(std::string_view name, std::string_view group) const;
    std::optional<AxisKind> kindFromAttributes(const NcVariable& variable,
                                               std::size_t position) const;
    const NcVariable* validTimeAlong(std::size_t dimension) const;
    Claim claimOf(const NcVariable& variable, std::size_t position) const;
    void findCoordinates();
    void findLists();
    void findTimes(std::span<const NcVariable* const> fields);
    bool isTimeElsewhere(const NcVariable& variable, std::size_t position) const;

    const NcHeader& header_;
    std::unordered_map<std::string, const NcVariable*> byName_;  // a file may have thousands
    std::vector<Dimension> dimensions_;                          // as the header's
};

}  // namespace timeseries
