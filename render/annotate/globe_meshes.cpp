#include "render/annotate/globe_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "render/annotate/axes_parts.h"
#include "render/annotate/labelled_edges.h"
#include "render/annotate/legend.h"
#include "render/annotate/map_lines.h"
#include "render/image/color.h"

namespace render {
namespace {

// The surface as an eye sees it; places in axis coordinates.
class Surface {
 public:
    Surface(const PlacedPoints& placed, const glm::dvec3& eye)
        : placed_(placed), globe_(*placed.globe()), eye_(eye) {}
    glm::dvec3 at(const glm::dvec2& degrees) const {
        return placed_.axesFromGlobe(globe_.at({degrees, globe_.surface()}));
    }
    // The cosine between the surface's normal and the way to the eye: positive before the horizon.
    double facing(const glm::dvec3& at) const {
        const glm::dvec3 normal = at - placed_.axesFromGlobe(glm::dvec3(0)), way = eye_ - at;
        return glm::dot(normal, way) / (glm::length(normal) * glm::length(way));
    }

 private:
    const PlacedPoints& placed_;
    const Globe& globe_;
    glm::dvec3 eye_;
};

// What an eye sees of a ball, as rings about the place that is nearest to it.
void drawBall(FlatMesh& mesh, const Screen& screen, const PlacedPoints::Ball& ball,
              const glm::dvec3& eye, float width) {
    constexpr int kRings = 32, kSectors = 128;
    const glm::vec3 nearest(linearFromSrgb8(38, 45, 57)), limb(linearFromSrgb8(22, 27, 35));
    const glm::dvec3 way = eye - ball.centre;
    const double distance = glm::length(way);
    if (!(distance > ball.radius)) return;
    const glm::dvec3 towards = way / distance;
    const glm::dvec3 beside = glm::normalize(
        glm::cross(towards, std::abs(towards.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 across = glm::cross(towards, beside);
    const double horizon = std::acos(ball.radius / distance);
    struct Corner {
        std::optional<glm::vec3> at;
        glm::vec4 color;
    };
    const auto corner = [&](int ring, int sector) -> Corner {
        const double off = horizon * ring / kRings,
                     round = 2 * std::numbers::pi * sector / kSectors;
        const glm::dvec3 normal =
            std::cos(off) * towards +
            std::sin(off) * (std::cos(round) * beside + std::sin(round) * across);
        const glm::dvec3 place = ball.centre + ball.radius * normal;
        const glm::dvec3 toEye = glm::normalize(eye - place);
        const auto lit = static_cast<float>(std::clamp(glm::dot(normal, toEye), 0.0, 1.0));
        Corner out{std::nullopt, glm::vec4(glm::mix(limb, nearest, lit), 1)};
        if (screen.visible(place, place, Screen::Cut::NearPlane)) out.at = screen.pixel(place);
        return out;
    };
    const auto triangle = [&](const Corner& a, const Corner& b, const Corner& c) {
        if (a.at && b.at && c.at) mesh.triangle({*a.at, *b.at, *c.at}, {a.color, b.color, c.color});
    };
    const auto cornersOf = [&](int ring) {
        std::vector<Corner> all;
        for (int sector = 0; sector <= kSectors; ++sector) all.push_back(corner(ring, sector));
        return all;
    };
    std::vector<Corner> inner = cornersOf(0), outer;
    for (int ring = 0; ring < kRings; ++ring, inner = std::move(outer)) {
        outer = cornersOf(ring + 1);
        for (std::size_t sector = 0; sector < kSectors; ++sector) {
            const Corner &a = inner[sector], &b = outer[sector], &c = outer[sector + 1],
                         &d = inner[sector + 1];
            triangle(a, b, c);
            if (ring > 0) triangle(a, c, d);
            // The limb's edge is smooth.
            if (ring + 1 == kRings && b.at && c.at) mesh.line(*b.at, *c.at, width, b.color);
        }
    }
}

// A line of degrees, as far as it lies before the horizon.
void drawOnGlobe(const Lines& into, const Screen& screen, const Surface& surface,
                 const MapLine& line) {
    constexpr double kStep = 1;  // degree
    std::vector<glm::dvec3> path;
    const auto end = [&] {
        drawPath(into, screen, path);
        path.clear();
    };
    for (std::size_t i = 1; i < line.size(); ++i) {
        const glm::dvec2 way = line[i] - line[i - 1];
        const int steps = std::max(
            1, static_cast<int>(std::ceil(std::max(std::abs(way.x), std::abs(way.y)) / kStep)));
        for (int n = i == 1 ? 0 : 1; n <= steps; ++n) {
            const glm::dvec3 at = surface.at(line[i - 1] + way * (static_cast<double>(n) / steps));
            if (surface.facing(at) > 0)
                path.push_back(at);
            else
                end();
        }
    }
    end();
}

// Where lines of degrees are drawn: everywhere, or as far about a smaller field as it is wide.
MapPlane shownPart(const Globe& globe) {
    const glm::dvec2 extent = globe.hi() - globe.lo();
    if (globe.isWhole()) return {{-180, -90}, {180, 90}, globe.surface(), 1};
    glm::dvec2 lo = globe.lo() - extent, hi = globe.hi() + extent;
    lo.y = std::max(lo.y, -90.0);
    hi.y = std::min(hi.y, 90.0);
    if (hi.x - lo.x > 360) lo.x = -180, hi.x = 180;
    return {lo, hi, globe.surface(), 1};
}

class DegreeLabels {
 public:
    DegreeLabels(const Surface& surface, const Sights& sights, const Globe& globe, glm::ivec2 size,
                 const Font& font, FontStyle style, std::span<const PixelRect> taken)
        : surface_(surface),
          screen_(sights.middle()),
          globe_(globe),
          places_(sights, size, taken),
          font_(font),
          style_(style) {}

    void meridian(double longitude) {
        const double field = globe_.lo().y;
        for (const double latitude : globe_.isWhole() ? std::vector{0.0, 30.0, -30.0, 60.0, -60.0}
                                                      : std::vector{field, globe_.hi().y})
            if (tryAt({longitude, latitude}, longitudeText(longitude))) return;
    }
    // Where the whole line is there, as far to the left as it can be read.
    void parallel(double latitude) {
        std::vector<double> longitudes{globe_.lo().x, globe_.hi().x};
        if (globe_.isWhole()) {
            std::vector<std::pair<double, double>> fromLeft;
            for (double each = -175; each < 180; each += 10) {
                const glm::dvec3 at = surface_.at({each, latitude});
                fromLeft.emplace_back(isSeen(at) ? screen_.pixel(at).x : 1e9, each);
            }
            std::ranges::sort(fromLeft);
            longitudes.clear();
            for (const auto& [left, each] : fromLeft) longitudes.push_back(each);
        }
        for (const double longitude : longitudes)
            if (tryAt({longitude, latitude}, latitudeText(latitude))) return;
    }
    const std::vector<Label>& labels() const { return labels_; }

 private:
    bool isSeen(const glm::dvec3& at) const {
        constexpr double kLegible = 0.3;
        return surface_.facing(at) > kLegible &&
               screen_.visible(at, at, Screen::Cut::NearPlane).has_value();
    }
    bool tryAt(const glm::dvec2& degrees, const std::string& text) {
        const glm::dvec3 anchor = surface_.at(degrees);
        if (!isSeen(anchor)) return false;
        const Label label = centred({text, inkOf(font_, style_, text)}, anchor, glm::dvec2(0));
        if (!places_.fits(label, 2, 0.4 * style_.linePixels)) return false;
        places_.take(label);
        labels_.push_back(label);
        return true;
    }

    const Surface& surface_;
    const Screen& screen_;
    const Globe& globe_;
    LabelPlaces places_;
    const Font& font_;
    FontStyle style_;
    std::vector<Label> labels_;
};

std::string degreesText(double degrees, const char* positive, const char* negative) {
    return fmt::format("{:g}°{}", std::abs(degrees),
                       degrees > 0   ? positive
                       : degrees < 0 ? negative
                                     : "");
}

double rounded(double degrees) { return std::round(degrees * 1e6) / 1e6; }

}  // namespace

std::string latitudeText(double degrees) { return degreesText(rounded(degrees), " N", " S"); }

std::string longitudeText(double degrees) {
    const double turned = rounded(std::remainder(degrees, 360));
    return std::abs(turned) == 180 ? "180°" : degreesText(turned, " E", " W");
}

AxesMeshes globeMeshes(const PlacedPoints& placed, const View& view, const Middle& middle,
                       const Font& font, const FlatMesh& legend, const glm::dvec3& background) {
    const FontStyle style = labelStyle(view.size);
    const Sights sights(view, middle, placed.boxHalf());
    const Screen& screen = sights.eye();
    const Globe& globe = *placed.globe();
    const Surface surface(placed, middle.eye);
    const float width = lineWidth(style);
    AxesMeshes meshes;

    const MapPlane part = shownPart(globe);
    std::vector<MapLine> graticule = graticuleOf(part);
    // Once round the last meridian is the first.
    const auto isMeridian = [](const MapLine& line) { return line.front().x == line.back().x; };
    std::erase_if(graticule, [&](const MapLine& line) {
        return isMeridian(line) && line.front().x >= part.lo.x + 360;
    });
    DegreeLabels labels(surface, sights, globe, view.size, font, style,
                        coveredByLegend(legend, view.size));
    for (const MapLine& line : graticule)
        if (!isMeridian(line) && std::abs(line.front().y) < 90) labels.parallel(line.front().y);
    for (const MapLine& line : graticule)
        if (isMeridian(line)) labels.meridian(line.front().x);
    const Pen pen{screen, font, style, groundColor(background)};
    for (const Label& label : labels.labels()) drawLabel(meshes, pen, label, lineColors().number);

    const std::vector<PixelRect> texts = textsOf(legend, meshes, width);
    drawBall(meshes.behind, screen, *placed.ball(), pixelRays(view).eye, width);
    // On what lies below the surface, under what lies above it.
    FlatMesh& mesh =
        globe.liesBelow() || globe.degreesPerUnit() == 0 ? meshes.mapBefore : meshes.behind;
    for (const MapLine& line : graticule)
        drawOnGlobe({mesh, texts, width, lineColors().graticule}, screen, surface, line);
    for (const MapLine& line : coastlines())
        drawOnGlobe({mesh, texts, width, lineColors().coast}, screen, surface, line);
    return meshes;
}

}  // namespace render
