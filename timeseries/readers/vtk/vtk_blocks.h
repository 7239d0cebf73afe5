// Whether the values that a DataArray of an XML file declares can be in the file: VTK allocates
// what a header says before it looks for the bytes. Layout: "VTK File Formats", Kitware, "XML file
// formats", and vtkXMLDataParser.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "timeseries/readers/vtk/vtk_xml.h"

namespace timeseries {

struct VtkEncoding {
    bool bigEndian = false;
    std::size_t headerBytes = 4;  // of each number before the values
    std::string compressor;       // "" for none
};

// From the attributes of the root. Throws FileError.
VtkEncoding vtkEncodingOf(const XmlFile& file);

// Throws FileError unless the file holds `values` values of `valueBytes` bytes for the DataArray.
// Returns the bytes of the file that they take; other arrays may name the same ones.
std::uint64_t checkVtkValues(const XmlFile& file, const VtkEncoding& encoding,
                             const XmlElement& array, std::string_view place, std::uint64_t values,
                             std::size_t valueBytes);

// The byte of the file at which the values begin, where they stand as they are in memory: not in
// text, not packed, in this machine's order of bytes. Throws FileError when they are not in it.
std::optional<std::uint64_t> rawVtkValuesAt(const XmlFile& file, const VtkEncoding& encoding,
                                            const XmlElement& array, std::string_view place);

// How many values of `valueBytes` bytes the DataArray says that it has. Throws FileError when it
// does not say.
std::uint64_t countVtkValues(const XmlFile& file, const VtkEncoding& encoding,
                             const XmlElement& array, std::string_view place,
                             std::size_t valueBytes);

// Few values, of so many bytes in all, in the file's order of bytes. Nothing where they are text,
// or packed by LZMA or in several blocks. Throws FileError when they are not in the file.
std::optional<std::string> readVtkValues(const XmlFile& file, const VtkEncoding& encoding,
                                         const XmlElement& array, std::string_view place,
                                         std::size_t bytes);

}  // namespace timeseries
