#include "app/panels/help.h"

#include "app/panels/widgets.h"

namespace app::panels {

void drawHelp(const Desk& desk) {
    const float s = desk.theme.scale, line = 23 * s, group = 14 * s;
    std::size_t groups = 0;
    std::string_view last;
    for (const HelpLine& help : helpLines()) {
        groups += help.group != last ? 1 : 0;
        last = help.group;
    }
    const float wanted =
        56 * s + static_cast<float>(helpLines().size()) * line + static_cast<float>(groups) * group;
    const Rect& picture = desk.layout.picture;
    const float squeeze = std::min(1.0f, (picture.size().y - 24 * s) / wanted);
    const float width = std::min(620 * s, picture.size().x - 24 * s);
    const glm::vec2 half(0.5f * width, 0.5f * wanted * squeeze);
    const Rect at{glm::floor(picture.centre() - half), glm::floor(picture.centre() + half)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(picture.min), im(picture.max), faded(kGround, 0.6f));
    list.AddRectFilled(im(at.min), im(at.max), faded(kPanel, 0.98f), 8 * s);
    list.AddRect(im(at.min), im(at.max), kLine, 8 * s);
    float y = at.min.y + 18 * s * squeeze;
    last = {};
    for (const HelpLine& help : helpLines()) {
        if (help.group != last) {
            y += group * squeeze;
            text(desk.theme, {at.min.x + 24 * s, y}, help.group, kAccent, 0, desk.theme.strong);
            last = help.group;
        }
        text(desk.theme, {at.min.x + 100 * s, y}, help.keys, kText);
        text(desk.theme, {at.min.x + 0.47f * width, y},
             fitting(*desk.theme.text, help.does, 0.53f * width - 20 * s), kDim);
        y += line * squeeze;
    }
}

}  // namespace app::panels
