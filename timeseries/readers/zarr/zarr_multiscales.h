// Images of OME-NGFF (versions 0.1 to 0.5, "multiscales" metadata): a group's arrays are one image
// at several resolutions, and it says what their axes are and where their points lie.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/zarr/zarr_hierarchy.h"

namespace timeseries {

// Point i lies at scale * i + offset.
struct ZarrPlaces {
    double scale = 1, offset = 0;
};

struct ZarrAxis {
    std::string name, units;
    std::optional<AxisKind> kind;  // in space or time
    bool isChannel = false;
    std::optional<ZarrPlaces> places;  // nothing where they are not said
};

struct ZarrLevel {
    std::string array;                  // its name in the hierarchy
    std::vector<ZarrAxis> axes;         // slowest first, as many as the array has dimensions
    std::vector<std::string> channels;  // their names, "" for those without
    bool areLabels = false;             // values are names of things (image-label)
};

// Of the images that a group's attributes tell of, the finest first; none when it is no such group.
// Throws std::invalid_argument: what was expected and found.
std::vector<ZarrLevel> zarrLevelsOf(const ZarrHierarchy& hierarchy, const ZarrGroup& group);

}  // namespace timeseries
