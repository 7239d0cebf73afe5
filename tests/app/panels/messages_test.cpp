// Cards over the picture.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/panels/focus.h"
#include "app/panels/widgets.h"
#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

using namespace std::chrono_literals;

class Messages : public testing::Test {
 protected:
    // What can be pressed over the picture, from the last card upwards.
    std::vector<Rect> buttons() {
        desk_.frames(2);
        std::vector<Rect> places;
        for (const Focus::Control& c : focus().controls())
            if (desk_.layout().picture.holds(c.at.centre())) places.push_back(c.at);
        return places;
    }
    std::vector<std::string> texts() const {
        std::vector<std::string> texts;
        for (const auto& message : desk_.exploration.messages()) texts.push_back(message.text);
        return texts;
    }

    tests::PanelsDesk desk_;
};

TEST_F(Messages, ShowTheLastErrorAndTheOthersBehindACounter) {
    using Texts = std::vector<std::string>;
    desk_.exploration.tell("a", true);
    EXPECT_EQ(buttons().size(), 1u) << "close";
    for (const char* text : {"b", "c", "d"}) desk_.exploration.tell(text, true);
    EXPECT_EQ(buttons().size(), 3u) << "the others, close all, close";
    desk_.click(buttons()[0].centre());
    EXPECT_EQ(buttons().size(), 2u + 4);
    // The one that is read is closed, and the one before it stands there.
    desk_.click(buttons()[0].centre());
    EXPECT_EQ(buttons().size(), 3u);
    desk_.click(buttons()[2].centre());
    EXPECT_EQ(texts(), (Texts{"a", "b", "c"}));
    desk_.exploration.tell("a note");
    EXPECT_EQ(buttons().size(), 1u + 3);
    desk_.click(buttons()[2].centre());
    EXPECT_EQ(texts(), Texts{"a note"});
}

TEST_F(Messages, ThatAreNoErrorsGoByThemselves) {
    desk_.exploration.tell("an error", true);
    desk_.exploration.tell("a note");
    desk_.frame();
    const auto wait = desk_.interface.untilNextChange();
    ASSERT_TRUE(wait);
    desk_.frames(static_cast<int>(*wait / 10ms) + 1);
    EXPECT_EQ(texts(), std::vector<std::string>{"an error"});
}

TEST_F(Messages, WaitWhileTheHelpLiesOverThem) {
    desk_.exploration.tell("a note");
    desk_.frame();
    const auto wait = desk_.interface.untilNextChange();
    ASSERT_TRUE(wait);
    const int whole = static_cast<int>(*wait / 10ms) + 1;
    desk_.interface.obey(desk_.exploration, Command::Help);
    desk_.frames(whole);
    EXPECT_EQ(texts(), std::vector<std::string>{"a note"});
    EXPECT_FALSE(desk_.interface.untilNextChange()) << "nothing goes by itself";
    desk_.interface.obey(desk_.exploration, Command::Help);
    desk_.frames(whole);
    EXPECT_TRUE(texts().empty());
}

TEST_F(Messages, BreakAtSpacesAndAfterSlashesAndWithinWordsThatAloneAreTooLong) {
    ImFont& font = *desk_.theme().text;
    const auto lines = [&](std::string_view text, std::string_view longest) {
        return inLines(font, text, widthOf(font, longest));
    };
    EXPECT_EQ(lines("Wrote io_13.png", "Wrote io_13."), "Wrote\nio_13.png");
    EXPECT_EQ(lines("/home/data/io_13.png", "/home/data/io_"), "/home/data/\nio_13.png");
    EXPECT_EQ(lines("aaaaaa", "aaaa"), "aaaa\naa");
    EXPECT_EQ(lines("éééé", "é"), "é\né\né\né");
    EXPECT_EQ(lines("one\ntwo", "one two"), "one\ntwo");
    EXPECT_EQ(lines("", "a"), "");
}

}  // namespace
}  // namespace app::panels
