#include "app/headset/panel.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <stdexcept>
#include <utility>

#include "app/panels/figures.h"

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
    const panels::Layout layout =
        panels::layoutOf(size, context_.theme.scale, interface_.choices().sideWidth);
    if (exploration.shown())
        asked.interaction = drawHandButtons(context_.theme, layout, around.buttons);
    panels::drawFigures(context_.theme, layout, around.performance, exploration.series());
    if (pointer)
        ImGui::GetForegroundDrawList()->AddCircleFilled(
            io.MousePos, 5 * kPanelScale, pointer->pressed ? panels::kAccent : panels::kText);
    ImGui::Render();
    if (isNew(*ImGui::GetDrawData())) {
        board_.beginDrawing();
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        board_.drawn();
        ++timesDrawn_;
    }
    return asked;
}

bool Panel::isNew(const ImDrawData& drawing) {
    drawing_.clear();
    const auto add = [&](const auto* from, std::size_t count) {
        const auto* bytes = reinterpret_cast<const std::byte*>(from);
        drawing_.insert(drawing_.end(), bytes, bytes + count * sizeof *from);
    };
    for (int i = 0; i < drawing.CmdListsCount; ++i) {
        const ImDrawList& list = *drawing.CmdLists[i];
        add(list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.Size));
        add(list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.Size));
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImTextureID texture = command.TextureId;
            add(&command.ClipRect, 1);
            add(&texture, 1);
            add(&command.ElemCount, 1);
        }
    }
    if (drawing_ == onBoard_) return false;
    std::swap(drawing_, onBoard_);
    return true;
}

}  // namespace app::headset
