// How stored numbers become values: _Unsigned, scale_factor and add_offset, and which stored
// numbers stand for nothing (CF 1.10, sections 2.5.1 and 8.1; NetCDF User's Guide, "Attribute
// Conventions").
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/readers/cf/netcdf_header.h"
#include "timeseries/readers/strided_layout.h"

namespace timeseries {

struct Packing {
    ValueType stored{};    // as the file means it: _Unsigned applied
    ValueType unpacked{};  // what values are after scale and offset
    bool scaled = false;   // value = stored * scale + offset, computed in the unpacked type
    double scale = 1, offset = 0;

    std::vector<Number> missing;  // stored numbers, equal to the fill or a missing value
    std::optional<Number> validMin, validMax;
    bool validUnpacked = false;  // the valid range is in unpacked values

    std::string storedAs;     // "int16 packed, scale 0.001, offset 15"
    std::string missingText;  // "_FillValue -32768"

    double unpack(double number) const { return scaled ? number * scale + offset : number; }
};

inline bool floating(ValueType type) { return type == ValueType::F32 || type == ValueType::F64; }

// NetCDF's fill for what was never written; bytes have none, for every byte may be meant
// (NetCDF User's Guide, "Attribute Conventions", _FillValue).
std::optional<Number> defaultFill(ValueType stored);

// `malformed` is called with what an attribute should have been, and does not return.
// REQUIRES: variable.type.
Packing packingOf(const NcVariable& variable,
                  const std::function<void(const std::string&)>& malformed);

// A stored number of that variable, or of an attribute of its type, as the file means it: with
// _Unsigned the bits are of the other signedness.
Number asMeant(const Packing& packing, const Number& stored);

// Fills `field`'s values and mask. `read` puts the stored numbers where it is told: straight into
// the field's values when they need no unpacking nor turning.
void unpack(const Packing& packing, const StridedLayout& layout,
            const std::function<void(void*)>& read, Field& field);

}  // namespace timeseries
