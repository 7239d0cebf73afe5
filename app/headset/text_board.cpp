#include "app/headset/text_board.h"

#include <array>
#include <glm/common.hpp>

#include "render/image/color.h"

namespace app::headset {
namespace {

constexpr render::FontStyle kStyle{render::FontWeight::Regular, 30};
constexpr double kMetresPerPixel = 0.0006;  // a line is 18 mm: 2 degrees at 0.5 m
constexpr int kMargin = 14;

glm::vec4 light(int red, int green, int blue) {
    const auto linear = [](int s) {
        return static_cast<float>(render::linearFromSrgb(static_cast<double>(s) / 255));
    };
    return {linear(red), linear(green), linear(blue), 1};
}

}  // namespace

TextBoard::TextBoard() : font_(std::array{kStyle}) {}

void TextBoard::write(const std::string& text) {
    if (text == text_) return;
    text_ = text;
    const glm::ivec2 size(glm::ceil(font_.measure(text, kStyle)) + 2.0f * kMargin);
    render::Image image(size, light(19, 25, 32));
    draw(image, font_, font_.layout(text, kStyle, glm::vec2(kMargin)), light(217, 224, 232));
    if (!board_ || board_->size() != size) board_.emplace(size);
    board_->write(image);
}

glm::dvec2 TextBoard::half() const { return 0.5 * kMetresPerPixel * glm::dvec2(board_->size()); }

}  // namespace app::headset
