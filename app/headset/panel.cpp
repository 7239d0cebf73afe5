#include "app/headset/panel.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <stdexcept>

namespace app::headset {

Panel::Context::Context() {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    theme = panels::makeTheme(kPanelScale);
    if (!ImGui_ImplOpenGL3_Init("#version 450 core"))
        throw std::runtime_error("Dear ImGui's OpenGL renderer did not start");
}

Panel::Context::~Context() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

Panel::Panel(std::function<void()> wake) : board_(kPanelPixels), interface_(std::move(wake)) {}
Panel::~Panel() = default;

Panel::Asked Panel::draw(Exploration& exploration, const std::optional<Pointer>& pointer,
                         const Around& around, std::chrono::nanoseconds dt) {
    ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 size(kPanelPixels);
    io.DisplaySize = {size.x, size.y};
    io.DeltaTime = std::max(1e-4f, std::chrono::duration<float>(dt).count());
    io.MousePos = {-FLT_MAX, -FLT_MAX};
    if (pointer) {
        const glm::vec2 at = glm::vec2(pointer->at) * size;
        io.MousePos = {at.x, at.y};
        io.MouseWheel += static_cast<float>(pointer->scroll);
    }
    io.MouseDown[0] = pointer && pointer->pressed;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    ImDrawList& ground = *ImGui::GetBackgroundDrawList();
    ground.AddRectFilled({0, 0}, io.DisplaySize, panels::kGround);
    if (exploration.shown())
        ground.AddText(context_.theme.text, context_.theme.text->FontSize,
                       {panels::kMargin * kPanelScale, 0.3f * size.y}, panels::kDim,
                       around.help.c_str());
    Asked asked;
    interface_.draw(exploration,
                    {.window = size,
                     .theme = context_.theme,
                     .offers = around.offers,
                     .eye = {},
                     .hasPicture = false,
                     .exporting = around.exporting,
                     .dt = dt,
                     .performance = around.performance},
                    asked.requests);
    if (exploration.shown())
        asked.room = drawRoomButtons(
            context_.theme,
            panels::layoutOf(size, context_.theme.scale, interface_.choices().sideWidth),
            around.buttons);
    if (pointer)
        ImGui::GetForegroundDrawList()->AddCircleFilled(
            io.MousePos, 5 * kPanelScale, pointer->pressed ? panels::kAccent : panels::kText);
    ImGui::Render();
    board_.beginDrawing();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    board_.drawn();
    return asked;
}

}  // namespace app::headset
