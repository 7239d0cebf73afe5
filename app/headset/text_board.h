// A text on a board of its own size, drawn again only when it changes.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "render/annotate/font.h"
#include "render/annotate/placard.h"

namespace app::headset {

// Needs a current GL context, from construction to destruction.
class TextBoard {
 public:
    TextBoard();
    // UTF-8, lines parted by '\n'. REQUIRES: not empty.
    void write(const std::string& text);
    // REQUIRES of both: something is written.
    const render::Board& board() const { return *board_; }
    glm::dvec2 half() const;  // metres: half its width and height, readable at arm's length

 private:
    render::Font font_;
    std::string text_;
    std::optional<render::Board> board_;
};

}  // namespace app::headset
