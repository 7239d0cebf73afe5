// How much room a text takes, and what of it fits. Pure ImGui.
#pragma once

#include <imgui.h>

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>

namespace app::panels {

// A text as ImGui takes one: never null, as an empty view's pointer may be, which ImGui reads, and
// well-formed. Of a byte that is no UTF-8, as names of old files have, ImGui would leave out those
// that follow.
struct Characters {
    explicit Characters(std::string_view what);
    Characters(const Characters&) = delete;
    Characters& operator=(const Characters&) = delete;

    std::string mended;  // of what is malformed
    const char *begin, *end;
};

// In one line.
glm::vec2 sizeOf(ImFont& font, std::string_view what);
float widthOf(ImFont& font, std::string_view what);

// The text, cut in its middle with an ellipsis to what fits; in one line of a width.
std::string shortened(std::string_view what, const std::function<bool(std::string_view)>& fits);
std::string fitting(ImFont& font, std::string_view what, float width);
// The longest beginning with an ellipsis that fits, or all of it.
std::string beginning(ImFont& font, std::string_view what, float width);
// The text in lines of a width, broken at spaces and after '/', and within a word only where it
// alone is too long.
std::string inLines(ImFont& font, std::string_view what, float width);

}  // namespace app::panels
