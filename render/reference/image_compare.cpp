#include "render/reference/image_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "render/image/color.h"

namespace render {

namespace {

double difference(double tested, double reference) {
    return tested == reference ? 0 : tested - reference;  // inf - inf would be NaN
}

// max that keeps a NaN once it has one.
double maxOrNan(double highest, double value) {
    return std::isnan(highest) || value <= highest ? highest : value;
}

template <class Tested, class Reference>
ScalarError compare(std::span<const Tested> tested, std::span<const Reference> reference) {
    assert(tested.size() == reference.size());
    ScalarError error;
    double errorSquared = 0, referenceSquared = 0, testedSum = 0, referenceSum = 0;
    for (std::size_t i = 0; i < tested.size(); ++i) {
        const double wanted = reference[i];
        const double off = std::abs(difference(tested[i], wanted));
        errorSquared += off * off;
        referenceSquared += wanted * wanted;
        testedSum += static_cast<double>(tested[i]);
        referenceSum += wanted;
        error.maxAbsolute = maxOrNan(error.maxAbsolute, off);
    }
    if (errorSquared != 0) {
        error.relativeL2 = std::sqrt(errorSquared / referenceSquared);
        error.massRatio = testedSum / referenceSum;
    }
    return error;
}

double encoded(double linear) {
    return std::isnan(linear) ? linear : srgbFromLinear(std::clamp(linear, 0.0, 1.0));
}

double decibels(double rmse) {
    return rmse == 0 ? std::numeric_limits<double>::infinity() : -20 * std::log10(rmse);
}

}  // namespace

ScalarError compareScalars(std::span<const float> tested, std::span<const float> reference) {
    return compare(tested, reference);
}

ScalarError compareScalars(std::span<const float> tested, std::span<const double> reference) {
    return compare(tested, reference);
}

ScalarError compareScalars(std::span<const double> tested, std::span<const double> reference) {
    return compare(tested, reference);
}

PictureError comparePictures(const Image& tested, const Image& reference, double tolerance) {
    if (tested.size != reference.size) {
        throw std::invalid_argument(
            fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared", tested.size.x,
                        tested.size.y, reference.size.x, reference.size.y));
    }
    PictureError error;
    double linearSquared = 0, encodedSquared = 0;
    for (std::size_t i = 0; i < tested.pixels.size(); ++i) {
        bool differs = false;
        for (int c = 0; c < 4; ++c) {
            const double a = tested.pixels[i][c], b = reference.pixels[i][c];
            const double off = std::abs(difference(a, b));
            differs = differs || !(off <= tolerance);
            error.maxAbsolute = maxOrNan(error.maxAbsolute, off);
            if (c == 3 || off == 0) continue;
            const double offEncoded = encoded(a) - encoded(b);
            linearSquared += off * off;
            encodedSquared += offEncoded * offEncoded;
        }
        error.differingPixels += differs;
    }
    const double count = 3 * std::max<double>(1, static_cast<double>(tested.pixels.size()));
    error.rmseLinear = std::sqrt(linearSquared / count);
    error.rmseEncoded = std::sqrt(encodedSquared / count);
    error.psnrLinear = decibels(error.rmseLinear);
    error.psnrEncoded = decibels(error.rmseEncoded);
    return error;
}

}  // namespace render
