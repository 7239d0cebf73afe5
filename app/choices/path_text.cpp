#include "app/choices/path_text.h"

#include <fmt/format.h>

#include <charconv>

#include "app/choices/choice_text.h"
#include "render/annotate/utf8.h"

namespace app {

bool isUtf8(std::string_view text) { return render::wellFormed(text) == text; }

std::string escaped(std::string_view path) {
    std::string text;
    while (!path.empty()) {
        const render::CodePoint first = render::firstPoint(path);
        if (first.isMalformed() || first.point == U'%')
            text += fmt::format("%{:02X}", static_cast<unsigned char>(path[0]));
        else
            text += path.substr(0, first.length);
        path.remove_prefix(first.length);
    }
    return text;
}

std::string unescaped(std::string_view text) {
    std::string path;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned char byte = static_cast<unsigned char>(text[i]);
        if (text[i] == '%') {
            const std::string_view digits = text.substr(i + 1, 2);
            const auto [end, error] =
                std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
            if (error != std::errc() || end != digits.data() + 2)
                throw ChoiceError("has a path with a % that no two hexadecimal digits follow");
            i += 2;
        }
        path += static_cast<char>(byte);
    }
    return path;
}

}  // namespace app
