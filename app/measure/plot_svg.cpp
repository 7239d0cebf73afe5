#include "app/measure/plot_svg.h"

#include <fmt/format.h>

#include <string_view>

#include "app/measure/plot_text.h"

namespace app {
namespace {

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : printable(text)) switch (c) {
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
                out += c;
        }
    return out;
}

std::string element(std::string_view name, std::string_view attributes,
                    std::string_view text = "") {
    return fmt::format("<{} {}>{}</{}>\n", name, attributes, escaped(text), name);
}

std::string hex(PlotColor color) { return fmt::format("#{:06x}", color); }

std::string_view word(Anchor anchor) {
    switch (anchor) {
        case Anchor::Start:
            return "start";
        case Anchor::Middle:
            return "middle";
        case Anchor::End:
            break;
    }
    return "end";
}

std::string svgOf(const PlotLine& line) {
    std::string attributes =
        fmt::format(R"(x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}")", line.from.x,
                    line.from.y, line.to.x, line.to.y, hex(line.color));
    if (line.width != 1) attributes += fmt::format(R"( stroke-width="{}")", line.width);
    if (line.dash > 0)
        attributes += fmt::format(R"( stroke-dasharray="{} {}")", line.dash, line.gap);
    return element("line", attributes);
}

std::string svgOf(const PlotCircle& circle) {
    return "<g>" + element("title", "", circle.tip) +
           element("circle",
                   fmt::format(
                       R"(cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}" stroke="{}" stroke-width="{}")",
                       circle.middle.x, circle.middle.y, circle.radius, hex(circle.fill),
                       hex(circle.rim), circle.rimWidth)) +
           "</g>\n";
}

std::string svgOf(const PlotText& text) {
    const bool bold = text.lettering.weight == render::FontWeight::SemiBold;
    return element(
        "text",
        fmt::format(R"(x="{:.1f}" y="{:.1f}" text-anchor="{}" font-size="{}"{} fill="{}")",
                    text.at.x, text.at.y, word(text.anchor), text.lettering.size,
                    bold ? R"( font-weight="600")" : "", hex(text.color)),
        text.text);
}

}  // namespace

std::string plotSvg(const Plot& plot) {
    std::string out = fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="Inter, Helvetica, Arial, sans-serif">
<rect width="{0}" height="{1}" fill="{2}"/>
)",
        plot.size.x, plot.size.y, hex(kPaper));
    for (const PlotShape& shape : plot.shapes)
        out += std::visit([](const auto& each) { return svgOf(each); }, shape);
    return out + "</svg>\n";
}

}  // namespace app
