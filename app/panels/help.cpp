#include "app/panels/help.h"

#include "app/panels/widgets.h"

namespace app::panels {

namespace {

// In this font at another size; its vertical middle at y.
void write(ImFont& font, float size, glm::vec2 at, std::string_view what, ImU32 color) {
    const Characters c(what);
    ImGui::GetWindowDrawList()->AddText(&font, size, im(glm::round(at - glm::vec2(0, 0.5f * size))),
                                        color, c.begin, c.end);
}

}  // namespace

void drawHelp(const PanelContext& context) {
    std::size_t groups = 0;
    std::string_view last;
    for (const HelpLine& help : helpLines()) {
        groups += help.group != last ? 1 : 0;
        last = help.group;
    }
    const Rect& picture = context.layout.picture;
    const auto [at, s] = helpLayout(picture, context.theme.scale, helpLines().size(), groups);
    ImFont &font = *context.theme.text, &strong = *context.theme.strong;
    const float size = font.FontSize * s / context.theme.scale, width = at.size().x;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(picture.min), im(picture.max), faded(kGround, 0.6f));
    list.AddRectFilled(im(at.min), im(at.max), faded(kPanel, 0.98f), 8 * s);
    list.AddRect(im(at.min), im(at.max), kLine, 8 * s);
    float y = at.min.y + 18 * s;
    last = {};
    for (const HelpLine& help : helpLines()) {
        if (help.group != last) {
            y += kHelpGroup * s;
            write(strong, size, {at.min.x + 24 * s, y}, help.group, kAccent);
            last = help.group;
        }
        write(font, size, {at.min.x + 100 * s, y}, help.keys, kText);
        const float room = (0.53f * width - 20 * s) * context.theme.scale / s;
        write(font, size, {at.min.x + 0.47f * width, y}, fitting(font, help.does, room), kDim);
        y += kHelpLine * s;
    }
}

}  // namespace app::panels
