#include "app/measure/plot_text.h"

#include "render/annotate/utf8.h"

namespace app {

std::string printable(std::string_view text) {
    std::string out = render::wellFormed(text);
    for (char& c : out)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return out;
}

}  // namespace app
