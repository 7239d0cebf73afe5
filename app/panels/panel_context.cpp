#include "app/panels/panel_context.h"

namespace app::panels {

std::optional<Rung> askedOfMoving(const Choices& choices, const DepthErrors* errors) {
    switch (choices.moving) {
        case Moving::Pace:
            return std::nullopt;
        case Moving::Error:
            return errors ? errors->cheapest(choices.movingError) : std::nullopt;
        case Moving::Fixed:
            return choices.movingRung;
        case Moving::All:
            return Rung();
    }
    return std::nullopt;
}

void beginRegion(const char* id, const Rect& at, ImU32 background, Depth depth) {
    ImGui::SetNextWindowPos(im(at.min));
    ImGui::SetNextWindowSize(im(glm::max(at.size(), glm::vec2(1))));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, background);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin(id, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollWithMouse |
                     (depth == Depth::Fixed ? ImGuiWindowFlags_NoBringToFrontOnFocus : 0));
}

void endRegion() {
    ImGui::End();
    ImGui::PopStyleVar(3);
    ImGui::PopStyleColor();
}

}  // namespace app::panels
