// How far a picture is from a reference. NaN never hides: a NaN on either side makes every figure
// it enters NaN and counts as a difference. Equal infinities are no difference.
#pragma once

#include <cstddef>
#include <span>

#include "render/image/image.h"

namespace render {

struct ScalarError {
    double relativeL2 = 0;   // ||tested - reference|| / ||reference||; see below for reference 0
    double maxAbsolute = 0;  // max |tested - reference|
    double massRatio = 1;    // sum of tested / sum of reference
};

// Against a reference that is zero everywhere, relativeL2 is 0 and massRatio 1 if `tested` is zero
// too, else both are infinite. REQUIRES: equal lengths. Sums are in double; `tested` and
// `reference` may be float or double.
ScalarError compareScalars(std::span<const float> tested, std::span<const float> reference);
ScalarError compareScalars(std::span<const float> tested, std::span<const double> reference);
ScalarError compareScalars(std::span<const double> tested, std::span<const double> reference);

// Over R, G and B of all pixels as they appear on black, which for premultiplied colour are the
// values themselves. Encoded figures clamp to [0, 1] and apply the sRGB curve without rounding to 8
// bits. PSNR is in dB for a peak of 1: 20 log10(1 / RMSE), infinite for equal pictures.
struct PictureError {
    double rmseLinear = 0;
    double rmseEncoded = 0;
    double psnrLinear = 0;
    double psnrEncoded = 0;
    double maxAbsolute = 0;           // linear, alpha included
    std::size_t differingPixels = 0;  // any of R, G, B, A apart by more than the tolerance
};

// Throws std::invalid_argument if the sizes differ.
PictureError comparePictures(const Image& tested, const Image& reference, double tolerance = 0);

}  // namespace render
