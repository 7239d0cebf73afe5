#include "app/picture/error_text.h"

#include <fmt/format.h>

#include <cmath>

namespace app {
namespace {

// Less is not told: nobody sees it.
constexpr double kLeastTold = 0.001;
// What sums in float lose is no part of anything.
constexpr double kNothing = 1e-6;

std::string orderReason(Ordering ordering) {
    return ordering == Ordering::Mixed ? kMixed : "colours within a cell";
}

}  // namespace

Bound boundOf(const RungError& known, const Rung& drawn) {
    return drawn.stride > known.rung.stride ? Bound::Least : Bound::About;
}

std::string rungText(const Rung& rung) {
    const std::string pixels = rung.across == 1 ? "" : ", coarse pixels";
    if (rung.model == Model::Cells) return "cells" + pixels;
    return (rung.stride == 1 ? "points" : fmt::format("1 of {} points", rung.stride)) + pixels;
}

std::string shareText(double error, Bound bound) {
    if (std::isnan(error)) return "not known";
    constexpr double kMostTold = 10;  // beside a truth that is nothing, or nearly so
    if (error > kMostTold) return "above 1000 %";
    const double percent = 100 * error;
    if (bound == Bound::Least)
        return fmt::format("above {:.{}f} %", percent, error < kLeastTold || percent >= 1 ? 0 : 1);
    if (error < kLeastTold) return "below 0.1 %";
    return fmt::format("{:.{}f} %", percent, percent < 1 ? 1 : 0);
}

std::string depthErrorText(double error, Bound bound) {
    if (std::isnan(error)) return "";  // nothing is drawn, and nothing is there
    const std::string share = shareText(error, bound);
    const bool isAbout = !share.starts_with("below") && !share.starts_with("above");
    return (isAbout ? "error about " : "error ") + share;
}

std::string unknownErrorText(const std::optional<DepthErrors>& errors, const Rung& drawn) {
    if (errors && (errors->find(drawn) || (errors->rungs.empty() && errors->whyNone.empty())))
        return "";
    return errors && !errors->whyNone.empty() ? "error not known" : "error not known yet";
}

std::string nothingSeenText(Model drawn) {
    const std::string text = "nothing is seen of what lies in the ranges";
    return drawn == Model::Cells ? text + " between the points" : text;
}

std::string lightErrorText(const RungError& error, Ordering ordering) {
    if (!(error.order >= kLeastTold)) return "";
    return fmt::format(", light {} ({})", shareText(error.order), orderReason(ordering));
}

std::vector<PartLine> partLines(const RungError& error, Ordering ordering,
                                const std::optional<Rung>& asDrawn) {
    const ErrorParts& parts = *error.parts;
    const Rung drawn = asDrawn.value_or(error.rung);
    const auto line = [](const char* name, double size, std::string some, std::string none) {
        return size < kNothing ? PartLine{name, "none", std::move(none)}
                               : PartLine{name, shareText(size), std::move(some)};
    };
    const bool cells = error.rung.model == Model::Cells;
    const std::string model = fmt::format("{} in place of the field between points",
                                          cells && std::isnan(error.order) ? "cells and points"
                                          : cells                          ? "cells"
                                                                           : "points");
    const std::string subset = rungText(drawn) + " for all of them";
    std::vector<PartLine> lines{
        line("model", parts.model, model, "exact here"),
        boundOf(error, drawn) == Bound::Least
            ? PartLine{"subset", shareText(parts.subset, Bound::Least), subset}
            : line("subset", parts.subset, subset, "all is drawn"),
        line("pixels", parts.pixels,
             error.rung.across == 1 ? "few rays a pixel instead of its mean"
                                    : "coarse pixels, and few rays in each",
             "as many rays as the truth")};
    if (std::isnan(error.order)) {
        lines.push_back({"order", "not known", "points among cells"});
        return lines;
    }
    switch (ordering) {
        case Ordering::OneColor:
            lines.push_back({"order", "none", "one colour"});
            break;
        case Ordering::Mixed:
            lines.push_back(line("order", error.order, "of light: colours mixed, not by depth",
                                 "no colours meet on a ray"));
            break;
        case Ordering::ByDepth:
            lines.push_back(line("order", error.order, "of light: colours within a cell",
                                 cells ? "cells by depth" : "points by depth"));
            break;
    }
    return lines;
}

}  // namespace app
