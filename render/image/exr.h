// OpenEXR: the picture as it was computed, 32-bit float linear light, for measuring and grading.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "render/image/image.h"

namespace render {

// What one camera sees.
struct ExrView {
    std::string name;  // "left", "right"; may be empty when there is one view only
    Image image;
    // Further channels of the same size and order, such as "opticalDepth"; no '.' in their names.
    std::map<std::string, std::vector<float>> scalars = {};

    bool operator==(const ExrView&) const = default;
};

// One file for all views, as in F. Kainz, "Storing Multi-View Images in OpenEXR Files" (2006): the
// attribute multiView lists them, the first is the default view whose channels are R, G, B, A and
// opticalDepth; those of the others are right.R, ..., right.opticalDepth. A single unnamed view
// writes no multiView. All channels are FLOAT; ZIP compression; chromaticities of Rec. 709;
// metadata become string attributes. REQUIRES: at least one view; named and of equal sizes if more;
// sizes >= 1; metadata keys that are not attributes of the format itself. Throws ImageError; the
// old file is then untouched.
void writeExr(const std::filesystem::path&, std::span<const ExrView>, const Metadata& = {});

struct ExrPicture {
    std::vector<ExrView> views;  // in the order of multiView
    Metadata metadata;           // all string attributes
};

// Single-part scan line or tiled files with R, G and B in every view (a missing A is 1). HALF and
// UINT channels are converted. The data window is the picture. Throws ImageError.
ExrPicture readExr(const std::filesystem::path&);

}  // namespace render
