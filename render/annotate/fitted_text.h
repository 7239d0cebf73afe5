// Text that has only so much room.
#pragma once

#include <string>
#include <vector>

#include "render/annotate/font.h"

namespace render {

// The longest beginning that fits, ended by an ellipsis; empty where not even that fits.
std::string shortened(const Font& font, FontStyle style, std::string text, float width);

// Broken between words into at most `most` lines that fit, the last ended by an ellipsis where
// there is more.
std::vector<std::string> wrapped(const Font& font, FontStyle style, const std::string& text,
                                 float width, std::size_t most);

}  // namespace render
