#include "app/panels/icons.h"

#include <array>
#include <initializer_list>
#include <numbers>

namespace app::panels {
namespace {

// Draws in units of the design around the icon's centre.
class Pen {
 public:
    Pen(ImDrawList& list, glm::vec2 centre, float scale, ImU32 color)
        : list_(list), centre_(centre), scale_(scale), color_(color) {}

    void line(std::initializer_list<glm::vec2> points, bool closed = false) {
        for (const glm::vec2& p : points) list_.PathLineTo(at(p));
        stroke(closed);
    }
    void arc(glm::vec2 centre, float radius, float fromTurns, float toTurns) {
        constexpr float kTurn = 2 * std::numbers::pi_v<float>;
        list_.PathArcTo(at(centre), radius * scale_, fromTurns * kTurn, toTurns * kTurn, 24);
        stroke(false);
    }
    void triangle(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
        list_.AddTriangleFilled(at(a), at(b), at(c), color_);
    }
    void bar(glm::vec2 lo, glm::vec2 hi) { list_.AddRectFilled(at(lo), at(hi), color_, scale_); }
    void dot(glm::vec2 centre, float radius) {
        list_.AddCircleFilled(at(centre), radius * scale_, color_);
    }
    void bezier(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
        list_.PathLineTo(at(a));
        list_.PathBezierQuadraticCurveTo(at(b), at(c), 16);
        stroke(false);
    }

 private:
    ImVec2 at(glm::vec2 p) const { return im(centre_ + scale_ * p); }
    void stroke(bool closed) {
        list_.PathStroke(color_, closed ? ImDrawFlags_Closed : 0, 1.4f * scale_);
    }
    ImDrawList& list_;
    glm::vec2 centre_;
    float scale_;
    ImU32 color_;
};

void eye(Pen& pen, bool open) {
    pen.bezier({-7, 0}, {0, 8}, {7, 0});
    if (!open) {
        pen.line({{-4.5f, 3.2f}, {-6, 5.6f}});
        pen.line({{0, 4.2f}, {0, 6.8f}});
        pen.line({{4.5f, 3.2f}, {6, 5.6f}});
        return;
    }
    pen.bezier({-7, 0}, {0, -8}, {7, 0});
    pen.dot({0, 0}, 2.2f);
}

void loop(Pen& pen) {
    pen.arc({0, 0}, 5.5f, 0.02f, 0.84f);
    pen.triangle({6.6f, -4.6f}, {6.6f, 0.6f}, {2.2f, -2.6f});
}

void pingPong(Pen& pen) {
    pen.line({{-6, -3}, {6, -3}});
    pen.line({{3, -6}, {6, -3}, {3, 0}});
    pen.line({{6, 3.5f}, {-6, 3.5f}});
    pen.line({{-3, 0.5f}, {-6, 3.5f}, {-3, 6.5f}});
}

void once(Pen& pen) {
    pen.line({{-7, 0}, {3.5f, 0}});
    pen.line({{0, -3.5f}, {3.5f, 0}, {0, 3.5f}});
    pen.line({{6.5f, -5}, {6.5f, 5}});
}

void step(Pen& pen, float way) {
    pen.triangle({-4 * way, -5.5f}, {4.5f * way, 0}, {-4 * way, 5.5f});
    const float x = 5.8f * way;
    pen.bar({x - 1, -5.5f}, {x + 1, 5.5f});
}

}  // namespace

void drawIcon(ImDrawList& list, Icon icon, glm::vec2 centre, float scale, ImU32 color) {
    Pen pen(list, centre, scale, color);
    switch (icon) {
        case Icon::Play:
            return pen.triangle({-4.5f, -7}, {7, 0}, {-4.5f, 7});
        case Icon::Pause:
            pen.bar({-5, -6.5f}, {-1.6f, 6.5f});
            return pen.bar({1.6f, -6.5f}, {5, 6.5f});
        case Icon::StepBack:
            return step(pen, -1);
        case Icon::StepForward:
            return step(pen, 1);
        case Icon::Once:
            return once(pen);
        case Icon::Loop:
            return loop(pen);
        case Icon::PingPong:
            return pingPong(pen);
        case Icon::Eye:
            return eye(pen, true);
        case Icon::EyeClosed:
            return eye(pen, false);
        case Icon::Remove:
            pen.line({{-4, -4}, {4, 4}});
            return pen.line({{-4, 4}, {4, -4}});
        case Icon::Add:
            pen.line({{-5, 0}, {5, 0}});
            return pen.line({{0, -5}, {0, 5}});
        case Icon::Menu:
            for (const float x : {-5.0f, 0.0f, 5.0f}) pen.dot({x, 0}, 1.5f);
            return;
        case Icon::Folder:
            return pen.line(
                {{-6.5f, -4.5f}, {-2, -4.5f}, {-0.5f, -2.5f}, {6.5f, -2.5f}, {6.5f, 5}, {-6.5f, 5}},
                true);
        case Icon::File:
            return pen.line(
                {{-4.5f, -6.5f}, {1.5f, -6.5f}, {4.5f, -3.5f}, {4.5f, 6.5f}, {-4.5f, 6.5f}}, true);
        case Icon::Down:
            return pen.line({{-3.5f, -1.8f}, {0, 1.8f}, {3.5f, -1.8f}});
    }
}

}  // namespace app::panels
