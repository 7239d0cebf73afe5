#include "app/measure/trade_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "app/measure/plot_text.h"
#include "app/measure/report.h"

namespace app {
namespace {

constexpr glm::ivec2 kSize{720, 480};
constexpr double kLeft = 84, kRight = 696, kTop = 84, kBottom = 412;
constexpr double kMark = 5;
constexpr PlotColor kInk = 0x24292f, kQuietInk = 0x57606a, kDecadeLine = 0xd0d7de,
                    kFineLine = 0xf0f2f4, kCellsMark = 0xc2410c, kPointsMark = 0x0969da;
constexpr Lettering kSmall{12}, kAxisName{13}, kTitle{16, render::FontWeight::SemiBold};

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

void addAxes(const Scale& x, const Scale& y, Plot& into) {
    const auto gridOf = [](const Scale& scale, const auto& draw) {
        for (int decade = scale.first(); decade <= scale.last(); ++decade) {
            for (int i = 2; i < 10 && decade < scale.last(); ++i)
                draw(scale.at(i * std::pow(10, decade)), kFineLine);
            draw(scale.at(std::pow(10, decade)), kDecadeLine);
        }
    };
    auto& shapes = into.shapes;
    gridOf(x, [&](double at, PlotColor color) {
        shapes.push_back(PlotLine{{at, kTop}, {at, kBottom}, color});
    });
    gridOf(y, [&](double at, PlotColor color) {
        shapes.push_back(PlotLine{{kLeft, at}, {kRight, at}, color});
    });
    for (int decade = x.first(); decade <= x.last(); ++decade)
        shapes.push_back(PlotText{{x.at(std::pow(10, decade)), kBottom + 20},
                                  Anchor::Middle,
                                  kSmall,
                                  kQuietInk,
                                  timeText(decade)});
    for (int decade = y.first(); decade <= y.last(); ++decade)
        shapes.push_back(PlotText{{kLeft - 8, y.at(std::pow(10, decade)) + 4},
                                  Anchor::End,
                                  kSmall,
                                  kQuietInk,
                                  fmt::format("{:g} %", 100 * std::pow(10, decade))});
    shapes.push_back(PlotText{
        {(kLeft + kRight) / 2, kBottom + 46}, Anchor::Middle, kAxisName, kInk, "time of a frame"});
    shapes.push_back(PlotText{{kLeft, kTop - 12},
                              Anchor::Start,
                              kAxisName,
                              kInk,
                              "error of optical depth (relative L2)"});
}

PlotColor colorOf(const Mode& mode) {
    return mode.rung.model == Model::Cells ? kCellsMark : kPointsMark;
}

// They join a model's modes of one order.
std::vector<PlotLine> joining(std::span<const Measured> modes, std::span<const glm::dvec2> places) {
    std::vector<PlotLine> lines;
    for (std::size_t i = 1; i < modes.size(); ++i) {
        const Mode &mode = modes[i].mode, &before = modes[i - 1].mode;
        if (mode.rung.model != before.rung.model || mode.rung.across != before.rung.across ||
            mode.order != before.order || mode.light != before.light)
            continue;
        PlotLine line{places[i - 1], places[i], colorOf(mode), 1.5};
        if (mode.order == render::Order::None) {
            line.dash = 4;
            line.gap = 3;
        }
        lines.push_back(line);
    }
    return lines;
}

std::string tipOf(const Measured& m) {
    return fmt::format("{}, {}: {:.3g} ms, error {:.2g}, mass {:+.1f} %", m.mode.name(),
                       orderText(m.mode.order), 1e3 * m.frame, m.depthError, 100 * (m.mass - 1));
}

void addMarks(std::span<const Measured> modes, std::span<const glm::dvec2> places, Plot& into) {
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const PlotColor color = colorOf(modes[i].mode);
        into.shapes.push_back(PlotCircle{.middle = places[i],
                                         .radius = kMark,
                                         .fill = modes[i].massIsOff() ? kPaper : color,
                                         .rim = color,
                                         .rimWidth = 2,
                                         .tip = tipOf(modes[i])});
    }
}

struct Box {
    double x, y, width, height;
    bool meets(const Box& b) const {
        return x < b.x + b.width && b.x < x + width && y < b.y + b.height && b.y < y + height;
    }
};

// A subset is told by its share alone, beside the mode that it is of: of those of one order in the
// picture's own pixels, which the others are beside.
bool isNamed(const Mode& mode, render::Order first) {
    return mode.rung.stride == 1 || (mode.rung.across == 1 && mode.order == first);
}
std::string nameOf(const Measured& m, bool severalOrders) {
    const Rung& rung = m.mode.rung;
    std::string name = rung.stride > 1 ? fmt::format("1/{}", rung.stride) : m.mode.name();
    if (severalOrders && rung.isWhole() && m.mode.light == render::Light::Off)
        name += ", " + orderText(m.mode.order);
    if (m.massIsOff() && rung.stride == 1)
        name += fmt::format(" (mass {:+.0f} %)", 100 * (m.mass - 1));
    return name;
}

// Where a name stands beside its mark, or farther away.
struct Offset {
    double right, down;  // which side, 0 for its middle; lines
};

// Right, left, above or below, then farther away.
std::vector<Offset> offsets() {
    std::vector<Offset> all{{1, 0}, {-1, 0}};
    for (const double away : {1.1, 2.0, 3.0, 4.0, 5.0})
        for (const double right : {0.0, 1.0, -1.0})
            for (const double down : {-away, away}) all.push_back({right, down});
    return all;
}

constexpr double kLine = 15;  // of names, from one to the next

Box besideMark(const glm::dvec2& mark, double width, const Offset& offset) {
    const double x = mark.x + offset.right * 2 * kMark + (offset.right - 1) / 2 * width;
    return {x, mark.y - kLine / 2 + offset.down * kLine, width, kLine};
}

// Where a name of such a width meets nothing in the plot that is taken; right of its mark where it
// does everywhere.
Box freePlace(const glm::dvec2& mark, double width, std::span<const Box> taken) {
    const auto isFree = [&](const Box& box) {
        return box.x > kLeft && box.x + box.width < kRight + kLine && box.y > kTop &&
               box.y + box.height < kBottom &&
               std::ranges::none_of(taken, [&](const Box& b) { return b.meets(box); });
    };
    for (const Offset& offset : offsets()) {
        const Box box = besideMark(mark, width, offset);
        if (isFree(box)) return box;
    }
    return besideMark(mark, width, {1, 0});
}

Box around(const glm::dvec2& middle, double half) {
    return {middle.x - half, middle.y - half, 2 * half, 2 * half};
}

// What marks and lines cover; a line is boxes so close that no name stands between them.
std::vector<Box> covered(std::span<const glm::dvec2> marks, std::span<const PlotLine> lines) {
    std::vector<Box> boxes;
    for (const glm::dvec2& mark : marks) boxes.push_back(around(mark, kMark));
    for (const PlotLine& line : lines) {
        const glm::dvec2 along = line.to - line.from;
        const double steps = std::ceil(glm::length(along) / (kLine / 4));
        for (double i = 1; i < steps; ++i)
            boxes.push_back(around(line.from + i / steps * along, line.width / 2));
    }
    return boxes;
}

// Where they meet nothing in `taken` nor each other.
void addNames(std::span<const Measured> modes, std::span<const glm::dvec2> places,
              bool severalOrders, const PlotFont& font, std::vector<Box> taken, Plot& into) {
    constexpr double kBelow = 4;
    for (std::size_t i = 0; i < modes.size(); ++i) {
        if (!isNamed(modes[i].mode, modes.front().mode.order)) continue;
        std::string name = nameOf(modes[i], severalOrders);
        const Box box = freePlace(places[i], font.width(name, kSmall), taken);
        taken.push_back(box);
        into.shapes.push_back(PlotText{{box.x, box.y + kLine / 2 + kBelow},
                                       Anchor::Start,
                                       kSmall,
                                       colorOf(modes[i].mode),
                                       std::move(name)});
    }
}

}  // namespace

Plot tradePlot(std::span<const Measured> modes, const std::string& title) {
    std::vector<double> times, errors;
    bool severalOrders = false;
    for (const Measured& m : modes) {
        times.push_back(m.frame);
        errors.push_back(m.depthError);
        severalOrders = severalOrders || (m.mode.order != modes.front().mode.order &&
                                          m.mode.light == modes.front().mode.light);
    }
    const Scale x(times, kLeft, kRight), y(errors, kBottom, kTop);
    std::vector<glm::dvec2> places;
    for (const Measured& m : modes) places.emplace_back(x.at(m.frame), y.at(m.depthError));
    const PlotFont font(std::array{kSmall, kTitle});
    Plot plot{kSize, {}};
    plot.shapes.push_back(PlotText{{kLeft, 32},
                                   Anchor::Start,
                                   kTitle,
                                   kInk,
                                   font.shortened(printable(title), kTitle, kRight - kLeft)});
    addAxes(x, y, plot);
    const std::vector<PlotLine> lines = joining(modes, places);
    plot.shapes.insert(plot.shapes.end(), lines.begin(), lines.end());
    addMarks(modes, places, plot);
    addNames(modes, places, severalOrders, font, covered(places, lines), plot);
    if (std::ranges::any_of(modes, &Measured::massIsOff))
        plot.shapes.push_back(PlotText{{kRight, kSize.y - 10},
                                       Anchor::End,
                                       kSmall,
                                       kQuietInk,
                                       "hollow: its mass is more than 5 % off"});
    return plot;
}

}  // namespace app
