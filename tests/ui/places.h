// Where things are in the window as it starts: one layer, the column's usual width, scale 1 or what
// is said.
#pragma once

#include "app/panels/layout.h"
#include "tests/ui/driver.h"

namespace ui {

struct Places {
    app::panels::Layout window;
    app::panels::HistogramLayout histogramPanel;
    app::panels::TimeBarLayout timeBar;
    // Of the picture, what lies clear of labels, one short message and figures; where messages
    // appear, and what is left of them.
    app::panels::Rect clear, messages, besideMessages;
};
Places placesOf(glm::ivec2 size, bool hasMap = true, float scale = 1);

// The middle of a tab, and where the control is of a page's i-th row, all being equally high; the
// page has so many gaps between groups of rows above it.
enum class Tab { Animation, View, Quality, Probe };
glm::vec2 tabPlace(const app::panels::SideLayout& side, Tab which);
app::panels::Rect pageRow(const app::panels::SideLayout& side, std::size_t i, std::size_t gaps = 0);

// Where the start screen makes its N-th offer (0 is the file panel); `recent`: files it knows.
glm::vec2 startOffer(glm::ivec2 window, std::size_t which, std::size_t recent);

// Waits until every step has been seen once: the time bar hatches those that were not, so that a
// cell of theirs has more than one colour. The steps must be few enough for cells to be wide.
void waitUntilSeen(Driver& desk, std::size_t steps, float scale = 1);

}  // namespace ui
