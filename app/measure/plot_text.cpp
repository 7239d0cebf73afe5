#include "app/measure/plot_text.h"

#include <cmath>

#include "render/annotate/fitted_text.h"
#include "render/annotate/flat_mesh.h"
#include "render/annotate/utf8.h"

namespace app {
namespace {

std::vector<render::FontStyle> stylesOf(std::span<const Lettering> letterings) {
    std::vector<render::FontStyle> styles;
    for (const Lettering& lettering : letterings) styles.push_back(PlotFont::style(lettering));
    return styles;
}

// The share of a text's width that lies left of its anchor.
double before(Anchor anchor) {
    switch (anchor) {
        case Anchor::Start:
            return 0;
        case Anchor::Middle:
            return 0.5;
        case Anchor::End:
            break;
    }
    return 1;
}

}  // namespace

std::string printable(std::string_view text) {
    std::string out = render::wellFormed(text);
    for (char& c : out)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return out;
}

PlotFont::PlotFont(std::span<const Lettering> letterings) : font_(stylesOf(letterings)) {}

// FontStyle counts from the ascender to the descender: of Inter 2728 + 680 units, 2816 to the em.
render::FontStyle PlotFont::style(const Lettering& lettering) {
    constexpr double kLine = 3408.0 / 2816;
    return {lettering.weight, static_cast<int>(std::lround(kPlotScale * kLine * lettering.size))};
}

double PlotFont::width(std::string_view text, const Lettering& lettering) const {
    return static_cast<double>(font_.measure(text, style(lettering)).x) / kPlotScale;
}

std::string PlotFont::shortened(const std::string& text, const Lettering& lettering,
                                double width) const {
    return render::shortened(font_, style(lettering), text, static_cast<float>(kPlotScale * width));
}

glm::dvec2 PlotFont::topLeft(const PlotText& text) const {
    const double toBaseline = render::inkOf(font_, style(text.lettering), "H").hi.y;
    const double toAnchor = before(text.anchor) * width(text.text, text.lettering);
    return static_cast<double>(kPlotScale) * (text.at - glm::dvec2(toAnchor, 0)) -
           glm::dvec2(0, toBaseline);
}

}  // namespace app
