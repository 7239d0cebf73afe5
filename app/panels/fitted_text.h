// How much room a text takes, and what of it fits. Pure ImGui.
#pragma once

#include <imgui.h>

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>

namespace app::panels {

// A text as ImGui takes one: never null, as an empty view's pointer may be, which ImGui reads.
struct Characters {
    explicit Characters(std::string_view what)
        : begin(what.empty() ? "" : what.data()), end(begin + what.size()) {}
    const char *begin, *end;
};

// In one line.
glm::vec2 sizeOf(ImFont& font, std::string_view what);
float widthOf(ImFont& font, std::string_view what);

// The text, cut in its middle with an ellipsis to what fits; in one line of a width.
std::string shortened(std::string_view what, const std::function<bool(std::string_view)>& fits);
std::string fitting(ImFont& font, std::string_view what, float width);
// The text in lines of a width, broken at spaces and after '/', and within a word only where it
// alone is too long.
std::string inLines(ImFont& font, std::string_view what, float width);

}  // namespace app::panels
