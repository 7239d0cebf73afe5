// What a file tells of the Earth beside axes of another kind, degrees about a rotated pole or
// lengths on a projection (CF 1.10, section 5.6): longitudes and latitudes of two dimensions, or
// where the pole is.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "timeseries/grid/earth_places.h"
#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/cf/cf_file.h"

namespace timeseries {

// Of variables their names.
struct EarthTold {
    struct Columns {
        std::string longitude, latitude;
        friend bool operator==(const Columns&, const Columns&) = default;
    };
    std::variant<Columns, RotatedPole> by;
    std::string x, y;  // the axes' coordinates
    friend bool operator==(const EarthTold&, const EarthTold&) = default;
};

// Nothing where the file tells nothing of it, or of columns that move. `geographic` as axesOf has
// it. REQUIRES: roles.x and roles.y.
std::optional<EarthTold> earthOf(const NcHeader& header, const FileAxes& fileAxes,
                                 const NcVariable& variable, const Roles& roles,
                                 std::span<const NcVariable* const> geographic);

// Read once of a file, for all variables.
class CfEarth {
 public:
    // Null where the axes tell the same, or where what the file tells are no places, or too many:
    // then what keeps it from being read, in words.
    struct Places {
        std::shared_ptr<const EarthPlaces> earth;
        std::string flaw;
    };
    const Places& of(const CfFile& file, const NcVariable& variable, const Roles& roles,
                     const EarthTold& told);

 private:
    struct Read {
        EarthTold told;
        Places places;
    };
    std::vector<Read> read_;
};

}  // namespace timeseries
