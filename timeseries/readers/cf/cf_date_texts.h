// Times that a file has as texts of dates: WRF's "Times", MPAS's "xtime", and what xarray and
// others write.
#pragma once

#include "timeseries/readers/cf/cf_file.h"
#include "timeseries/readers/cf/cf_time.h"

namespace timeseries {

// The dates as seconds since the first of them, in the calendar that the texts or the file name. As
// they are, with a note, where one of the texts is no date. REQUIRES: `times` is counted.
void readDateTexts(const CfFile& file, const NcVariable& texts, StoredTimes& times);

}  // namespace timeseries
