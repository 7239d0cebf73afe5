// Pictures whose captions say what their legends would.
#include <gtest/gtest.h>

#include "app/picture/picture.h"

namespace app {
namespace {

TEST(Picture, HasTheLegendUnlessNoneIsWanted) {
    Explorer e;
    const render::Legend legend{
        .title = "T", .time = "1 s", .layers = {{}}, .notes = {"stretched"}};
    EXPECT_EQ(asDrawn(e, legend).title, "T");
    EXPECT_EQ(asDrawn(e, legend).layers.size(), 1u);
    e.legend = false;
    const render::Legend none = asDrawn(e, legend);
    EXPECT_EQ(none.title + none.time + none.emptiness, "");
    EXPECT_TRUE(none.layers.empty() && none.notes.empty());
}

}  // namespace
}  // namespace app
