// Every control of every panel and pop-up, once with the mouse and once with the keys. None is
// listed here: controls make themselves known to Focus as they are drawn, and what opens before
// them is found by operating them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <ostream>
#include <set>

#include "app/panels/focus.h"
#include "app/picture/picture.h"
#include "app/picture/resolved.h"
#include "tests/support/files.h"
#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

using Control = Focus::Control;
enum class By { Mouse, Keys };

const std::string kLong = [] {
    std::string text = "too long for a card: ";
    while (text.size() < 1000) text += "and so on, ";
    return text;
}();

// Two errors, and no other message.
void tellErrors(Exploration& exploration) {
    while (!exploration.messages().empty())
        exploration.forgetMessage(exploration.messages().back().number);
    exploration.tell("short", true);
    exploration.tell(kLong, true);
}

tests::World named(std::size_t variables, std::size_t steps) {
    tests::World world{.variables = {}, .steps = steps};
    for (std::size_t i = 0; i < variables; ++i) world.variables.push_back(fmt::format("v{}", i));
    return world;
}

bool isInView(const Control& c) { return c.clip.holds(c.at.centre()); }

// Goes through all that there is.
class Hands {
 public:
    // `restore` makes again what is no part of the explorer.
    Hands(tests::PanelsDesk& desk, std::function<void()> restore)
        : desk_(desk), restore_(std::move(restore)) {
        restore_();
        settle();
    }

    // All that is reached from here: what stands in front once `openers` were clicked in turn.
    void operateAll(const std::vector<Control>& openers = {}) {
        if (!reach(openers)) return;
        const std::vector<Control> all(focus().controls().begin(), focus().controls().end());
        if (all.empty()) return;
        if (!openers.empty() && !fronts_.insert(all.front().id).second) return;
        expectTabToReachAll();
        for (const Control& each : all)
            for (const By by : {By::Mouse, By::Keys})
                if (operate(openers, each, by)) {
                    std::vector<Control> further = openers;
                    further.push_back(each);
                    operateAll(further);
                }
    }
    std::size_t operated() const { return operated_; }
    std::size_t fronts() const { return fronts_.size(); }

 private:
    // As it is drawn now: by its name, or where it was (a message that is told again has another).
    static const Control* find(const Control& as) {
        const auto controls = focus().controls();
        auto found = std::ranges::find(controls, as.id, &Control::id);
        if (found == controls.end()) found = std::ranges::find(controls, as.at, &Control::at);
        return found == controls.end() ? nullptr : &*found;
    }
    static bool isThere(ImGuiID id) {
        return std::ranges::count(focus().controls(), id, &Control::id) > 0;
    }
    static bool isBehindSomething() {
        return !focus().controls().empty() && focus().controls().front().depth > 0;
    }

    // Waits for what was begun; nothing plays, nothing is open.
    void settle() {
        desk_.untilOpened();
        desk_.frames(3);
        while (desk_.interface.isListing()) desk_.frame();
        desk_.frame();
    }
    void closeAll() {
        for (int i = 0; i < 4 && (isBehindSomething() || focus().holder()); ++i)
            desk_.press(Key::Escape);
        desk_.frames(2);
        EXPECT_FALSE(isBehindSomething()) << "Escape does not close it";
        EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
    }
    bool reach(const std::vector<Control>& openers) {
        closeAll();
        const Page page = desk_.interface.choices().page;
        desk_.interface.choices() = {};
        desk_.interface.choices().page = page;
        desk_.frame();
        for (const Control& each : openers) {
            const Control* opener = find(each);
            EXPECT_NE(opener, nullptr);
            if (opener == nullptr) return false;
            desk_.click(opener->at.centre());
            settle();
        }
        return true;
    }

    void expectTabToReachAll() {
        std::set<ImGuiID> wanted, reached;
        for (const Control& c : focus().controls())
            if (c.isStop) wanted.insert(c.id);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            desk_.press(Key::Tab);
            ASSERT_TRUE(focus().holder());
            reached.insert(*focus().holder());
        }
        EXPECT_EQ(reached, wanted);
    }

    // With the keys, from the stop before it. False for one that Tab passes over.
    bool tabTo(ImGuiID id) {
        std::vector<ImGuiID> stops;
        for (const Control& c : focus().controls())
            if (c.isStop) stops.push_back(c.id);
        const auto at = std::ranges::find(stops, id);
        if (at == stops.end()) return false;
        focus().touch(at == stops.begin() ? stops.back() : at[-1]);
        desk_.press(Key::Tab);
        EXPECT_EQ(focus().holder(), id);
        desk_.frames(2);  // scrolled to, and a field has the text
        return true;
    }

    void withMouse(const Control& as) {
        if (!isInView(*find(as)) && !tabTo(find(as)->id)) return;
        const Control c = *find(as);
        ASSERT_TRUE(isInView(c));
        desk_.moveTo(c.at.centre());
        desk_.hold(true);
        EXPECT_EQ(focus().place(), c.id) << "something else has taken the mouse";
        EXPECT_FALSE(focus().holder()) << "a click gives the keys back";
        desk_.hold(false);
        desk_.frame();
        if (c.takes == Focus::Takes::Typing) {
            desk_.type("1");
            EXPECT_THAT(desk_.asked.commands, testing::IsEmpty());
            desk_.press(Key::Enter);
        }
    }

    void withKeys(const Control& as) {
        if (!tabTo(find(as)->id)) return;
        switch (find(as)->takes) {
            case Focus::Takes::Nothing:
                return desk_.press(Key::Enter);
            case Focus::Takes::LeftRight:
                for (const Key key : {Key::Right, Key::Left, Key::Home, Key::End}) desk_.press(key);
                return;
            case Focus::Takes::UpDown:
                for (const Key key : {Key::Up, Key::Down}) desk_.press(key);
                return;
            case Focus::Takes::Typing:
                desk_.type("1");
                EXPECT_THAT(desk_.asked.commands, testing::IsEmpty());
                return desk_.press(Key::Enter);
        }
    }

    // Goes back, or on where it was itself that went back, to where it was. All but where the swept
    // window stands, which is no edit.
    void expectUndoToBring(const Explorer& before) {
        Exploration& exploration = desk_.exploration;
        const auto isThere = [&] {
            Explorer now = exploration.explorer();
            now.play.tick = before.play.tick;
            return now == before;
        };
        if (exploration.playback().playing) exploration.togglePlay();
        while (!isThere() && exploration.canUndo()) {
            exploration.undo();
            desk_.untilOpened();
        }
        while (!isThere() && exploration.canRedo()) {
            exploration.redo();
            desk_.untilOpened();
        }
        EXPECT_TRUE(isThere()) << "undo does not bring back what was";
        exploration.seekTick(before.play.tick);
    }

    // True where something came before it that is not known yet.
    bool operate(const std::vector<Control>& openers, const Control& control, By by) {
        SCOPED_TRACE(fmt::format("the {}th, control {:#x} at {}, {}, {} deep, with the {}",
                                 operated_, control.id, control.at.min.x, control.at.min.y,
                                 openers.size(), by == By::Mouse ? "mouse" : "keys"));
        if (!reach(openers) || find(control) == nullptr) {
            ADD_FAILURE() << "it is gone";
            return false;
        }
        const Explorer before = desk_.exploration.explorer();
        const Page page = desk_.interface.choices().page;
        ++operated_;
        by == By::Mouse ? withMouse(control) : withKeys(control);
        settle();
        EXPECT_TRUE(!focus().holder() || isThere(*focus().holder()))
            << "what has the keys is not there";
        const bool further =
            isBehindSomething() && !fronts_.contains(focus().controls().front().id);
        closeAll();
        desk_.interface.choices().page = page;
        if (desk_.exploration.shown()) {
            EXPECT_FALSE(needsSamples(desk_.exploration.explorer()));
            expectUndoToBring(before);
        }
        restore_();
        settle();
        return further;
    }

    tests::PanelsDesk& desk_;
    std::function<void()> restore_;
    std::set<ImGuiID> fronts_;  // what has opened, by its first control
    std::size_t operated_ = 0;
};

// A page, on a file.
struct Files {
    std::size_t variables, steps;
    Page page;
    friend void PrintTo(const Files& f, std::ostream* to) { *to << f.variables << " variables"; }
};
std::string nameOf(const testing::TestParamInfo<Files>& of) {
    constexpr std::array kPages = {"Animation", "View", "Quality", "Probe"};
    return fmt::format("{}Variables{}", of.param.variables,
                       kPages[static_cast<std::size_t>(of.param.page)]);
}

class EveryControl : public testing::TestWithParam<Files> {
 protected:
    // What the file panel lists: a folder and a file.
    EveryControl() {
        const auto folder = tests::freshFolder();
        std::filesystem::create_directory(folder / "below");
        tests::writeBytes(folder / "one.nc", "");
        std::filesystem::current_path(folder);
    }
};

TEST_P(EveryControl, IsOperatedWithMouseAndKeys) {
    const auto& [variables, steps, page] = GetParam();
    tests::PanelsDesk desk(named(variables, steps));
    Explorer e = desk.exploration.explorer();
    e.layers = {tests::layer("4:20"), tests::layer("30:50")};
    e.layers[1].color = MapChoice{.map = {}, .lo = 0, .hi = 64};
    e.lamp = LampChoice{-10, 50};
    desk.exploration.edit(e);
    desk.sweep("1:63", 2);
    desk.untilAllSeen();
    const std::vector<Named> recent{{"one.nc"}, {"two.nc"}};
    desk.offers = {.recent = recent, .demo = {}, .autosave = "left.session.json"};
    desk.exporting = "Exporting picture 3 of 10";
    desk.performance.report.counts = PointCounts{.layers = {7, 7, 7}, .selected = 7, .total = 64};
    desk.performance.errors = DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = 0.03}}};
    desk.interface.choices().page = page;

    Hands hands(desk, [&] {
        tellErrors(desk.exploration);
        desk.interface.takeReading(Reading{.value = 3.0}, false);
    });
    hands.operateAll();
    // The menu, the files, the variables, three colours, where the error comes from.
    EXPECT_EQ(hands.fronts(), 7u);
    EXPECT_GT(hands.operated(), 100u);
}

INSTANTIATE_TEST_SUITE_P(All, EveryControl,
                         testing::Values(Files{1, 1, Page::Quality}, Files{2, 10, Page::Animation},
                                         Files{2, 10, Page::View}, Files{60, 3, Page::Probe}),
                         nameOf);

// Before there are data.
TEST(EveryControlOfTheStart, IsOperatedWithMouseAndKeys) {
    tests::PanelsDesk desk(std::nullopt);
    const std::vector<Named> recent{{"one.nc"}, {"two.nc"}};
    desk.offers = {.recent = recent, .demo = "demo.nc", .autosave = "left.session.json"};
    Hands hands(desk, [&] { tellErrors(desk.exploration); });
    hands.operateAll();
    EXPECT_EQ(hands.fronts(), 1u);
    EXPECT_GT(hands.operated(), 2u * 5);
}

}  // namespace
}  // namespace app::panels
