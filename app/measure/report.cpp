#include "app/measure/report.h"

#include <fmt/format.h>

#include <cmath>

#include "app/files/dataset.h"

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
        "{:<12} {:<9} {:>9} {:>9} {:>12} {:>8} {:>9}  {:>8} {:>6} {:>8} {:>7}\n", "mode", "order",
        "frame", "before", "drawn", "depth L2", "mass  ", "RMSE", "PSNR", "largest", "dE 95 %");
    bool isOff = false;
    for (const Measured& m : modes) {
        text += fmt::format(
            "{:<12} {:<9} {:>9} {:>9} {:>12} {:>8.4f} {:>9}{} {:>8.2e} {:>6.1f} {:>8.2e} "
            "{:>7.2f}\n",
            m.mode.name(), orderText(m.mode.order), timeText(m.frame), timeText(m.before),
            withCommas(static_cast<std::uint64_t>(m.drawn)), m.depthError, massText(m),
            m.massIsOff() ? "" : "  ", m.rmse, m.psnr, m.largest, m.colorDifference);
        isOff = isOff || m.massIsOff();
    }
    if (isOff)
        text +=
            fmt::format("! its mass is more than {:.0f} % off: a fast picture, but not of this\n",
                        100 * kMassTolerance);
    return text;
}

ordered_json json(const Measured& m) {
    return {{"mode", m.mode.name()},
            {"order", orderText(m.mode.order)},
            {"frame", m.frame},
            {"before", m.before},
            {"drawn", static_cast<std::uint64_t>(m.drawn)},
            {"depthError", finite(m.depthError)},
            {"mass", finite(m.mass)},
            {"massIsOff", m.massIsOff()},
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
