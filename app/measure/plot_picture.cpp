#include "app/measure/plot_picture.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/measure/plot_text.h"
#include "render/annotate/flat_raster.h"
#include "render/image/color.h"

namespace app {
namespace {

glm::vec4 lightOf(PlotColor color) {
    const auto byte = [&](int shift) { return static_cast<int>(color >> shift & 0xff); };
    return {glm::vec3(render::linearFromSrgb8(byte(16), byte(8), byte(0))), 1};
}

glm::vec2 pixelOf(const glm::dvec2& at) { return glm::vec2(at * double{kPlotScale}); }

std::vector<Lettering> letteringsOf(const Plot& plot) {
    std::vector<Lettering> found;
    for (const PlotShape& shape : plot.shapes)
        if (const auto* text = std::get_if<PlotText>(&shape))
            if (std::ranges::find(found, text->lettering) == found.end())
                found.push_back(text->lettering);
    return found;
}

// Draws shapes into a mesh, in picture pixels.
class MeshWriter {
 public:
    explicit MeshWriter(const PlotFont& font) : font_(font) {}

    void operator()(const PlotLine& line) {
        const double length = glm::distance(line.from, line.to);
        if (!(line.dash > 0)) return stroke(line, 0, 1);
        for (double at = 0; at < length; at += line.dash + line.gap)
            stroke(line, at / length, std::min((at + line.dash) / length, 1.0));
    }
    void operator()(const PlotCircle& circle) {
        disc(circle.middle, circle.radius + circle.rimWidth / 2, circle.rim);
        if (circle.fill != circle.rim)
            disc(circle.middle, circle.radius - circle.rimWidth / 2, circle.fill);
    }
    void operator()(const PlotText& text) {
        PlotText shown = text;
        shown.text = printable(text.text);
        mesh_.text(font_.font(), PlotFont::style(shown.lettering), shown.text,
                   glm::vec2(font_.topLeft(shown)), glm::vec3(lightOf(shown.color)));
    }
    const render::FlatMesh& mesh() const { return mesh_; }

 private:
    // The part of a line from one share of its length to another.
    void stroke(const PlotLine& line, double first, double last) {
        const auto at = [&](double share) {
            return glm::vec3(pixelOf(line.from + share * (line.to - line.from)), 0);
        };
        mesh_.line(at(first), at(last), static_cast<float>(kPlotScale * line.width),
                   lightOf(line.color));
    }
    void disc(const glm::dvec2& middle, double radius, PlotColor color) {
        if (radius > 0)
            mesh_.disc(pixelOf(middle), static_cast<float>(kPlotScale * radius), lightOf(color));
    }

    const PlotFont& font_;
    render::FlatMesh mesh_;
};

}  // namespace

render::Image plotPicture(const Plot& plot) {
    const PlotFont font(letteringsOf(plot));
    MeshWriter writer(font);
    for (const PlotShape& shape : plot.shapes) std::visit(writer, shape);
    const glm::ivec2 size = plot.size * kPlotScale;
    render::Image picture(size, lightOf(kPaper));
    const render::FlatRaster raster(writer.mesh(), font.font(), size);
    for (int y = 0; y < size.y; ++y)  // a picture begins at its top, a raster's rows at its foot
        raster.draw({size, size.y - 1 - y, 1, &picture.at(0, y).x});
    return picture;
}

}  // namespace app
