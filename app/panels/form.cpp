#include "app/panels/form.h"

#include <cmath>

namespace app::panels {

Form::Form(const Theme& theme, const char* id, const Rect& at)
    : theme_(theme),
      left_(at.min.x + kMargin * theme.scale),
      right_(at.max.x - kMargin * theme.scale) {
    const glm::vec2 grip(kGrip * theme.scale, 0);
    ImGui::SetCursorScreenPos(im(at.min + grip));
    ImGui::BeginChild(id, im(at.size() - grip));
    origin_ = vec(ImGui::GetCursorScreenPos());
    y_ = origin_.y + 10 * theme.scale;
}

Form::~Form() {
    ImGui::SetCursorScreenPos({origin_.x, y_});
    ImGui::Dummy({1, 6 * theme_.scale});
    ImGui::EndChild();
}

Rect Form::row(std::string_view label) {
    const float s = theme_.scale, height = 28 * s;
    const float left = label.empty() ? left_ : left_ + 104 * s;
    const Rect at{{left, y_}, {right_, y_ + height}};
    if (!label.empty())
        text(theme_, {left_, at.centre().y}, fitting(*theme_.text, label, left - left_ - 6 * s),
             kDim);
    y_ += height + 8 * s;
    return at;
}

void Form::note(std::string_view what, ImU32 color) {
    const float s = theme_.scale;
    ImGui::SetCursorScreenPos({left_, y_});
    ImGui::PushFont(theme_.small);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(right_ - ImGui::GetWindowPos().x);
    const Characters c(what);
    ImGui::TextUnformatted(c.begin, c.end);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
    y_ = ImGui::GetItemRectMax().y + 8 * s;
}

Rect part(const Rect& row, std::size_t i, std::size_t n, float scale) {
    const float gap = 8 * scale;
    const float width = (row.size().x - gap * static_cast<float>(n - 1)) / static_cast<float>(n);
    const float left = row.min.x + (width + gap) * static_cast<float>(i);
    return {{std::floor(left), row.min.y}, {std::floor(left + width), row.max.y}};
}

}  // namespace app::panels
