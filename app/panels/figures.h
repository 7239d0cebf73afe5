// The figures below the picture: how many points it has, how true it is, and how fast it came.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/panels/panel_context.h"

namespace app::panels {

// A line each; none before the first picture.
std::vector<std::string> figuresOf(const Performance& performance,
                                   const timeseries::Series* series);
// As drawFigures() has them, in lines that have room, and where the error stands, which is pressed
// there; none where it is not told.
struct ShownFigures {
    std::vector<std::string> lines = {};
    std::optional<Rect> error = {};
};
ShownFigures shownFigures(const Theme& theme, const Layout& layout, const Performance& performance,
                          const timeseries::Series* series);
// What is said of the error where the pointer asks for it: what each way to draw would have. Empty
// where it is not known.
std::vector<std::string> errorLines(const Performance& performance);
// Under all panels. After the picture is drawn that they are of, and before ImGui renders.
void drawFigures(const Theme& theme, const Layout& layout, const Performance& performance,
                 const timeseries::Series* series);

}  // namespace app::panels
