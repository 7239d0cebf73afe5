// Rows of a page: a label, and beside it a control, in aligned columns.
#pragma once

#include <string_view>

#include "app/panels/panel_context.h"
#include "app/panels/widgets.h"

namespace app::panels {

class Form {
 public:
    // Begins a scrolling region; the destructor ends it.
    Form(const Theme& theme, const char* id, const Rect& at);
    ~Form();
    Form(const Form&) = delete;
    Form& operator=(const Form&) = delete;

    // The rectangle of the next row's control. Without a label it takes the whole width.
    Rect row(std::string_view label = {});
    // A line of text of its own.
    void note(std::string_view what, ImU32 color = kDim);
    void space(float units) { y_ += units * theme_.scale; }

 private:
    const Theme& theme_;
    glm::vec2 origin_;
    float left_, right_, y_;
};

// Part i of n equal ones of a row, with gaps.
Rect part(const Rect& row, std::size_t i, std::size_t n, float scale);

}  // namespace app::panels
