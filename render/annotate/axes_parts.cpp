#include "render/annotate/axes_parts.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "render/image/color.h"

namespace render {

void lineAround(FlatMesh& mesh, std::span<const PixelRect> texts, const glm::dvec3& from,
                const glm::dvec3& to, float width, const glm::vec4& color) {
    for (const glm::dvec2& piece : piecesOutside(glm::dvec2(from), glm::dvec2(to), texts))
        mesh.line(glm::mix(from, to, piece[0]), glm::mix(from, to, piece[1]), width, color);
}

void drawPath(const Lines& into, const Screen& screen, std::span<const glm::dvec3> places) {
    constexpr double kApart = 1.5;  // pixels
    std::optional<glm::dvec3> last;
    for (std::size_t i = 1; i < places.size(); ++i) {
        const glm::dvec3 &from = places[i - 1], &to = places[i];
        const auto part = screen.visible(from, to, Screen::Cut::NearPlane);
        if (part) {
            const glm::dvec3 end = screen.pixel(glm::mix(from, to, part->y));
            if (!last || part->x > 0) last = screen.pixel(glm::mix(from, to, part->x));
            const bool isLast = i + 1 == places.size() || part->y < 1;
            if (isLast || glm::distance(glm::dvec2(*last), glm::dvec2(end)) >= kApart) {
                lineAround(into.mesh, into.texts, *last, end, into.width, into.color);
                last = end;
            }
        }
        if (!part || part->y < 1) last.reset();
    }
}

void drawLabel(AxesMeshes& meshes, const Pen& pen, const Label& label, const glm::vec3& color) {
    const glm::dvec3 at = pen.screen.pixel(label.anchor);
    const auto depth = static_cast<float>(at.z);
    const glm::vec2 topLeft = glm::round(glm::dvec2(at) + label.topLeft);
    meshes.labels.text(pen.font, pen.style, label.text, topLeft, color, depth);
    if (!meshes.labels.covers().empty())
        meshes.grounds.plate(meshes.labels.covers().back(),
                             0.2f * static_cast<float>(pen.style.linePixels), pen.ground, depth);
}

float lineWidth(FontStyle style) {
    return std::max(1.0f, 0.06f * static_cast<float>(style.linePixels));
}

std::vector<PixelRect> textsOf(const FlatMesh& legend, const AxesMeshes& meshes, float width) {
    std::vector<PixelRect> texts;
    for (const std::vector<PixelRect>& all : {legend.covers(), meshes.labels.covers()})
        for (const PixelRect& covers : all)
            texts.push_back(covers.grown(0.5 * static_cast<double>(width) + 1.5));
    return texts;
}

const LineColors& lineColors() {
    const auto rgb = [](int r, int g, int b) { return glm::vec3(linearFromSrgb8(r, g, b)); };
    static const LineColors colors{rgb(134, 145, 162),
                                   rgb(84, 94, 110),
                                   rgb(52, 59, 71),
                                   rgb(170, 179, 193),
                                   rgb(230, 233, 239),
                                   glm::vec4(0.8f * rgb(160, 170, 184), 0.8f),
                                   glm::vec4(0.06f * rgb(160, 170, 184), 0.06f)};
    return colors;
}

}  // namespace render
