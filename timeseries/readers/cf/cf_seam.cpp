#include "timeseries/readers/cf/cf_seam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "timeseries/grid/grid.h"
#include "timeseries/readers/cf/cf_polygons.h"

namespace timeseries {
namespace {

constexpr double kTurn = 360;

// Whole turns that each place is moved by, so that neighbours are within half a turn.
class Turns {
 public:
    Turns(const std::vector<glm::dvec3>& places, const std::array<std::size_t, 3>& size,
          double turn)
        : places_(places), size_(size), turn_(turn), of_(places.size(), kNone) {}

    // Not of what is far from any longitude.
    bool anySeam() const {
        constexpr double kMost = 100;  // turns
        if (std::ranges::any_of(places_, [&](const glm::dvec3& at) {
                return std::isfinite(at.x) && std::abs(at.x) > kMost * turn_;
            }))
            return false;
        return anyPair([&](std::size_t a, std::size_t b) { return between(a, b) != 0; });
    }
    // False where there is no one answer, or it leads farther around than a cell or a few.
    bool find() {
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (isThere(i) && of_[i] == kNone && !findFrom(i)) return false;
        return !anyPair(
            [&](std::size_t a, std::size_t b) { return of_[b] - of_[a] != between(a, b); });
    }
    double moved(std::size_t i) const { return places_[i].x + turn_ * of_[i]; }
    bool isThere(std::size_t i) const {
        return std::isfinite(places_[i].x) && std::isfinite(places_[i].y);
    }

 private:
    static constexpr int kNone = std::numeric_limits<int>::min();

    int between(std::size_t a, std::size_t b) const {
        return static_cast<int>(std::round((places_[a].x - places_[b].x) / turn_));
    }
    template <typename Use>
    void forEachNeighbour(std::size_t i, const Use& use) const {
        const std::size_t ni = size_[0], x = i % ni, y = i / ni;
        if (x > 0) use(i - 1);
        if (x + 1 < ni) use(i + 1);
        if (y > 0) use(i - ni);
        if (y + 1 < size_[1]) use(i + ni);
    }
    template <typename Is>
    bool anyPair(const Is& is) const {
        bool any = false;
        for (std::size_t i = 0; i < places_.size() && !any; ++i)
            if (isThere(i))
                forEachNeighbour(i, [&](std::size_t other) {
                    any = any || (other > i && isThere(other) && is(i, other));
                });
        return any;
    }
    // All that neighbours lead to, so that the least longitude is in -180 to 180.
    bool findFrom(std::size_t first) {
        constexpr double kMost = 1.25;  // turns: files repeat columns where they begin anew
        std::vector<std::size_t> found{first};
        of_[first] = 0;
        double lo = places_[first].x, hi = lo;
        for (std::size_t next = 0; next < found.size(); ++next) {
            const std::size_t i = found[next];
            lo = std::min(lo, moved(i));
            hi = std::max(hi, moved(i));
            if (hi - lo > kMost * turn_) return false;
            forEachNeighbour(i, [&](std::size_t other) {
                if (!isThere(other) || of_[other] != kNone) return;
                of_[other] = of_[i] + between(i, other);
                found.push_back(other);
            });
        }
        const int back = static_cast<int>(std::floor(lo / turn_ + 0.5));
        for (const std::size_t i : found) of_[i] -= back;
        return true;
    }

    const std::vector<glm::dvec3>& places_;
    const std::array<std::size_t, 3>& size_;
    double turn_;
    std::vector<int> of_;
};

// The longest way along which there is no longitude: a little before its end, and its length.
struct Gap {
    double end = 0, length = 0;
};
Gap longestGap(const std::vector<double>& longitudes, const std::vector<double>& latitudes) {
    constexpr std::size_t kBins = 3600;
    constexpr double kBin = kTurn / kBins;
    std::vector<bool> taken(kBins);
    for (std::size_t i = 0; i < longitudes.size(); ++i) {
        if (!std::isfinite(longitudes[i]) || isPole(latitudes[i], kTurn)) continue;
        const double away = longitudes[i] / kTurn + 0.5;
        const auto bin = static_cast<std::size_t>((away - std::floor(away)) * kBins);
        taken[std::min(bin, kBins - 1)] = true;
    }
    Gap longest;
    std::size_t before = 0;
    for (std::size_t n = 0; n < 2 * kBins; ++n) {
        before = taken[n % kBins] ? 0 : before + 1;
        const double length = kBin * static_cast<double>(before);
        if (length <= longest.length || before > kBins) continue;
        longest = {kBin * (static_cast<double>((n + 1) % kBins) - 0.5) - 180, length};
    }
    return longest;
}

}  // namespace

void goOnAcrossTheSeam(std::vector<double>& longitudes) {
    if (longitudes.size() < 3) return;
    const double up = longitudes[1] > longitudes[0] ? 1 : -1;
    const auto turned = std::ranges::adjacent_find(
        longitudes, [&](double a, double b) { return !((b - a) * up > 0); });
    if (turned == longitudes.end()) return;
    std::vector<double> on = longitudes;
    const auto seam = on.begin() + (turned - longitudes.begin()) + 1;
    // Nearer to Greenwich: of 300, 0 it is -60, 0; of 170, -170 it is 170, 190.
    if ((*seam >= 0) == (up > 0))
        std::for_each(on.begin(), seam, [&](double& v) { v -= up * kTurn; });
    else
        std::for_each(seam, on.end(), [&](double& v) { v += up * kTurn; });
    if (flawOf(on).empty() && std::abs(on.back() - on.front()) < kTurn) longitudes = std::move(on);
}

void goOnAcrossTheSeam(std::vector<glm::dvec3>& places, const std::array<std::size_t, 3>& size,
                       double turn) {
    if (!(turn > 0)) return;
    Turns turns(places, size, turn);
    if (!turns.anySeam() || !turns.find()) return;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (turns.isThere(i)) places[i].x = turns.moved(i);
}

void goOnAcrossTheSeam(std::vector<double>& longitudes, const std::vector<double>& latitudes) {
    constexpr double kLeast = kTurn / 10;
    if (longitudes.size() != latitudes.size()) return;  // told by who takes them together
    const Gap gap = longestGap(longitudes, latitudes);
    if (!(gap.length >= kLeast) || gap.length >= kTurn) return;
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (std::size_t i = 0; i < longitudes.size(); ++i) {
        if (!std::isfinite(longitudes[i]) || isPole(latitudes[i], kTurn)) continue;
        lo = std::min(lo, longitudes[i]);
        hi = std::max(hi, longitudes[i]);
    }
    if (hi - lo <= kTurn - gap.length) return;
    for (double& each : longitudes) each -= kTurn * std::floor((each - gap.end) / kTurn);
}

}  // namespace timeseries
