// The grids of an XDMF file in time.
#pragma once

#include <string>
#include <vector>

#include "timeseries/readers/xdmf/xdmf_document.h"
#include "timeseries/readers/xdmf/xdmf_items.h"

namespace timeseries {

struct XdmfStep {
    double time = 0;                 // where its series has times
    std::vector<XdmfElement> parts;  // Uniform grids, at least one
};

// A collection in time, or what has no time: all that the file's Domain holds beside such.
struct XdmfSeries {
    bool hasTimes = false;
    std::vector<XdmfStep> steps;  // at least one
    std::string note = {};        // why the file's own times are not taken
};

// Those that have an Attribute. Throws FileError.
std::vector<XdmfSeries> xdmfSeriesOf(const XdmfDocument& document, XdmfItems& items);

}  // namespace timeseries
