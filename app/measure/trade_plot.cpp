#include "app/measure/trade_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "app/measure/report.h"
#include "render/annotate/utf8.h"

namespace app {
namespace {

constexpr double kWidth = 720, kHeight = 480;
constexpr double kLeft = 84, kRight = 696, kTop = 84, kBottom = 412;
constexpr double kMark = 5;

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : render::wellFormed(text)) switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                // No SVG may have other control characters.
                out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
        }
    return out;
}

std::string element(std::string_view name, std::string_view attributes,
                    std::string_view text = "") {
    return fmt::format("<{} {}>{}</{}>\n", name, attributes, escaped(text), name);
}

std::string label(double x, double y, std::string_view anchor, std::string_view style,
                  std::string_view text) {
    return element("text",
                   fmt::format(R"(x="{:.1f}" y="{:.1f}" text-anchor="{}" {})", x, y, anchor, style),
                   text);
}

// A logarithmic axis from `from` to `to` in the picture, whole decades.
class Scale {
 public:
    Scale(std::span<const double> values, double from, double to) : from_(from), to_(to) {
        double least = kMost, most = 0;
        for (const double v : values) {
            if (!(v > 0) || !std::isfinite(v)) continue;
            least = std::min(least, v);
            most = std::max(most, v);
        }
        if (!(most > 0)) least = most = 1;
        first_ = static_cast<int>(std::floor(std::log10(least) + 1e-9));
        last_ = std::max(first_ + 1, static_cast<int>(std::ceil(std::log10(most) - 1e-9)));
    }
    // What lies outside, as an error of 0 does, stands at the end.
    double at(double value) const {
        const double place = value > 0 ? (std::log10(value) - first_) / (last_ - first_) : 0;
        return from_ + (to_ - from_) * std::clamp(place, 0.0, 1.0);
    }
    int first() const { return first_; }
    int last() const { return last_; }

 private:
    static constexpr double kMost = 1e300;
    double from_, to_;
    int first_ = 0, last_ = 1;
};

std::string timeText(int decade) {
    const double seconds = std::pow(10, decade);
    if (decade >= 0) return fmt::format("{:g} s", seconds);
    return decade >= -3 ? fmt::format("{:g} ms", 1e3 * seconds)
                        : fmt::format("{:g} \u00b5s", 1e6 * seconds);
}

constexpr const char* kSmall = R"(font-size="12" fill="#57606a")";

std::string axes(const Scale& x, const Scale& y) {
    std::string out;
    const auto line = [&](double x1, double y1, double x2, double y2, const char* color) {
        out += element("line",
                       fmt::format(R"(x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}")",
                                   x1, y1, x2, y2, color));
    };
    const auto both = [&](const Scale& scale, const auto& draw) {
        for (int decade = scale.first(); decade <= scale.last(); ++decade) {
            for (int i = 2; i < 10 && decade < scale.last(); ++i)
                draw(scale.at(i * std::pow(10, decade)), "#f0f2f4");
            draw(scale.at(std::pow(10, decade)), "#d0d7de");
        }
    };
    both(x, [&](double at, const char* color) { line(at, kTop, at, kBottom, color); });
    both(y, [&](double at, const char* color) { line(kLeft, at, kRight, at, color); });
    for (int decade = x.first(); decade <= x.last(); ++decade)
        out += label(x.at(std::pow(10, decade)), kBottom + 20, "middle", kSmall, timeText(decade));
    for (int decade = y.first(); decade <= y.last(); ++decade)
        out += label(kLeft - 8, y.at(std::pow(10, decade)) + 4, "end", kSmall,
                     fmt::format("{:g} %", 100 * std::pow(10, decade)));
    constexpr const char* kName = R"(font-size="13" fill="#24292f")";
    out += label((kLeft + kRight) / 2, kBottom + 46, "middle", kName, "time of a frame");
    out += label(kLeft, kTop - 12, "start", kName, "error of optical depth (relative L2)");
    return out;
}

const char* colorOf(const Mode& mode) {
    if (mode.model == Model::Cells) return "#c2410c";
    return "#0969da";
}

struct Place {
    double x, y;
};

// Joins a model's modes of one order.
std::string joined(std::span<const Measured> modes, std::span<const Place> places) {
    std::string out;
    for (std::size_t i = 1; i < modes.size(); ++i)
        if (modes[i].mode.model == modes[i - 1].mode.model &&
            modes[i].mode.order == modes[i - 1].mode.order)
            out += element(
                "line",
                fmt::format(
                    R"(x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}" stroke-width="1.5"{})",
                    places[i - 1].x, places[i - 1].y, places[i].x, places[i].y,
                    colorOf(modes[i].mode),
                    modes[i].mode.order == render::Order::None ? R"( stroke-dasharray="4 3")"
                                                               : ""));
    return out;
}

std::string marks(std::span<const Measured> modes, std::span<const Place> places) {
    std::string out;
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const char* color = colorOf(modes[i].mode);
        const std::string tip =
            fmt::format("{}, {}: {:.3g} ms, error {:.2g}, mass {:+.1f} %", modes[i].mode.name(),
                        orderText(modes[i].mode.order), 1e3 * modes[i].frame, modes[i].depthError,
                        100 * (modes[i].mass - 1));
        out +=
            "<g>" + element("title", "", tip) +
            element("circle",
                    fmt::format(
                        R"(cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}" stroke="{}" stroke-width="2")",
                        places[i].x, places[i].y, kMark, modes[i].massIsOff() ? "#ffffff" : color,
                        color)) +
            "</g>\n";
    }
    return out;
}

struct Box {
    double x, y, width, height;
    bool meets(const Box& b) const {
        return x < b.x + b.width && b.x < x + width && y < b.y + b.height && b.y < y + height;
    }
};

// A subset is told by its share alone, beside the mode that it is of.
std::string nameOf(const Measured& m, bool severalOrders) {
    std::string name = m.mode.stride > 1 ? fmt::format("1/{}", m.mode.stride) : m.mode.name();
    if (severalOrders && m.mode.stride == 1) name += ", " + orderText(m.mode.order);
    if (m.massIsOff() && m.mode.stride == 1)
        name += fmt::format(" (mass {:+.0f} %)", 100 * (m.mass - 1));
    return name;
}

// Beside their marks, where they meet neither another name nor a mark: right, left, above or below,
// then farther away.
std::string names(std::span<const Measured> modes, std::span<const Place> places,
                  bool severalOrders) {
    constexpr double kLine = 15, kLetter = 6.6, kBeside = 2 * kMark, kBelow = 4;
    std::vector<Box> taken;
    for (const Place& p : places) taken.push_back({p.x - kMark, p.y - kMark, 2 * kMark, 2 * kMark});
    std::string out;
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const std::string name = nameOf(modes[i], severalOrders);
        const double width = kLetter * static_cast<double>(name.size());
        const auto boxAt = [&](double right, double down) {
            const double x = places[i].x + right * kBeside -
                             (right > 0   ? 0
                              : right < 0 ? width
                                          : width / 2);
            return Box{x, places[i].y - kLine / 2 + down * kLine, width, kLine};
        };
        const auto isFree = [&](const Box& box) {
            return box.x > kLeft && box.x + width < kRight + kLine && box.y > kTop &&
                   box.y + kLine < kBottom &&
                   std::ranges::none_of(taken, [&](const Box& b) { return b.meets(box); });
        };
        Box box = boxAt(1, 0);
        for (const double away : {1.1, 2.0, 3.0, 4.0, 5.0})
            for (const auto& [right, down] :
                 {Place{1, 0}, Place{-1, 0}, Place{0, -away}, Place{0, away}, Place{1, -away},
                  Place{1, away}, Place{-1, -away}, Place{-1, away}})
                if (!isFree(box)) box = boxAt(right, down);
        if (!isFree(box)) box = boxAt(1, 0);
        taken.push_back(box);
        out += label(box.x, box.y + kLine / 2 + kBelow, "start",
                     fmt::format(R"(font-size="12" fill="{}")", colorOf(modes[i].mode)), name);
    }
    return out;
}

}  // namespace

std::string tradePlot(std::span<const Measured> modes, const std::string& title) {
    std::vector<double> times, errors;
    bool severalOrders = false;
    for (const Measured& m : modes) {
        times.push_back(m.frame);
        errors.push_back(m.depthError);
        severalOrders = severalOrders || m.mode.order != modes.front().mode.order;
    }
    const Scale x(times, kLeft, kRight), y(errors, kBottom, kTop);
    std::vector<Place> places;
    for (const Measured& m : modes) places.push_back({x.at(m.frame), y.at(m.depthError)});
    const bool isOff = std::ranges::any_of(modes, &Measured::massIsOff);
    return fmt::format(
               R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="Inter, Helvetica, Arial, sans-serif">
<rect width="{0}" height="{1}" fill="#ffffff"/>
)",
               kWidth, kHeight) +
           label(kLeft, 32, "start", R"(font-size="16" font-weight="600" fill="#24292f")", title) +
           axes(x, y) + joined(modes, places) + marks(modes, places) +
           names(modes, places, severalOrders) +
           (isOff ? label(kRight, kHeight - 10, "end", kSmall,
                          "hollow: its mass is more than 5 % off")
                  : std::string()) +
           "</svg>\n";
}

}  // namespace app
