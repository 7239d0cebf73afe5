#include "app/measure/report.h"

#include <fmt/format.h>

#include <cmath>

#include "app/choices/choice_text.h"
#include "app/files/dataset.h"
#include "app/measure/best_modes.h"

namespace app {
namespace {

using nlohmann::ordered_json;

ordered_json finite(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

std::string timeText(double seconds) {
    return seconds < 1 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} s", seconds);
}

std::string massText(const Measured& m) {
    return fmt::format("{:+.2f} %{}", 100 * (m.mass - 1), m.massIsOff() ? " !" : "");
}

}  // namespace

std::string orderText(render::Order order) {
    return order == render::Order::None ? "mixed" : "by depth";
}

std::string table(std::span<const Measured> modes) {
    std::string text = fmt::format(
        "{:<17} {:<9} {:>9} {:>9} {:>12} {:>8} {:>9}  {:>8} {:>8} {:>8} {:>6} {:>8} {:>7}\n",
        "mode", "order", "frame", "before", "drawn", "depth L2", "mass  ", "in float", "popping",
        "RMSE", "PSNR", "largest", "dE 95 %");
    bool isOff = false;
    for (const Measured& m : modes) {
        text += fmt::format(
            "{:<17} {:<9} {:>9} {:>9} {:>12} {:>8.4f} {:>9}{} {:>8.1e} {:>8.4f} {:>8.2e} {:>6.1f} "
            "{:>8.2e} {:>7.2f}\n",
            m.mode.name(), orderText(m.mode.order), timeText(m.frame), timeText(m.before),
            withCommas(static_cast<std::uint64_t>(m.drawn)), m.depthError, massText(m),
            m.massIsOff() ? "" : "  ", m.arithmetic, m.popping, m.rmse, m.psnr, m.largest,
            m.colorDifference);
        isOff = isOff || m.massIsOff();
    }
    if (isOff)
        text +=
            fmt::format("! its mass is more than {:.0f} % off: a fast picture, but not of this\n",
                        100 * kMassTolerance);
    return text;
}

std::string bestTable(std::span<const Measured> modes) {
    std::string text;
    const auto add = [&](const std::vector<BestMode>& best, std::string_view head,
                         const auto& limitText) {
        if (best.empty()) return;
        text += fmt::format("\n{}\n", head);
        for (const auto& [limit, mode] : best)
            text += mode ? fmt::format("  {:<8} {:<17} {:>9}  error {:.4f}\n", limitText(limit),
                                       modes[*mode].mode.name(), timeText(modes[*mode].frame),
                                       modes[*mode].depthError)
                         : fmt::format("  {:<8} none\n", limitText(limit));
    };
    add(mostAccurateWithin(modes), "the most accurate within a time a frame:", [](double seconds) {
        return timeText(seconds);
    });
    add(soonestWithin(modes),
        "the soonest within an error:", [](double error) { return fmt::format("{:g}", error); });
    return text;
}

ordered_json bestJson(std::span<const Measured> modes) {
    const auto listed = [&](const std::vector<BestMode>& best, const char* limitName) {
        ordered_json list = ordered_json::array();
        for (const auto& [limit, mode] : best)
            list.push_back({{limitName, limit},
                            {"mode", mode ? ordered_json(modes[*mode].mode.name()) : nullptr}});
        return list;
    };
    return {{"mostAccurate", listed(mostAccurateWithin(modes), "frame")},
            {"soonest", listed(soonestWithin(modes), "depthError")}};
}

ordered_json json(const Measured& m) {
    const ErrorParts parts = m.parts.parts.value_or(ErrorParts());
    return {{"mode", m.mode.name()},
            {"order", orderText(m.mode.order)},
            {"light", lightName(m.mode.light)},
            {"frame", m.frame},
            {"before", m.before},
            {"drawn", static_cast<std::uint64_t>(m.drawn)},
            {"depthError", finite(m.depthError)},
            {"sampledError", finite(m.parts.depth)},
            {"modelError", finite(parts.model)},
            {"subsetError", finite(parts.subset)},
            {"pixelsError", finite(parts.pixels)},
            {"orderError", finite(m.parts.order)},
            {"arithmeticError", finite(m.arithmetic)},
            {"mass", finite(m.mass)},
            {"massIsOff", m.massIsOff()},
            {"popping", finite(m.popping)},
            {"rmse", finite(m.rmse)},
            {"psnr", finite(m.psnr)},
            {"largest", finite(m.largest)},
            {"colorDifference", finite(m.colorDifference)}};
}

std::string csv(std::span<const Measured> modes) {
    std::string text;
    for (const Measured& m : modes) {
        const ordered_json row = json(m);
        std::string head, line;
        for (const auto& [key, value] : row.items()) {
            const std::string cell = value.is_string() ? value.get<std::string>() : value.dump();
            head += (head.empty() ? "" : ",") + key;
            line += (line.empty() ? "" : ",") + (value.is_null() ? std::string() : cell);
        }
        text += (text.empty() ? head + "\n" : "") + line + "\n";
    }
    return text;
}

}  // namespace app
