// Globes that take long are made beside what is shown, which goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <map>
#include <optional>
#include <thread>

#include "render/points/placed_points.h"
#include "tests/support/exploration_desk.h"
#include "tests/support/measured_axis.h"

namespace app {
namespace {

using namespace std::chrono_literals;
using render::Map;
using tests::layer;
using tests::measuredAxis;
using tests::World;
using timeseries::Grid;

std::array<timeseries::Axis, 3> space() {
    return {measuredAxis("lon", "degrees_east", 0, 358, 180),
            measuredAxis("lat", "degrees_north", -88, 88, 45),
            measuredAxis("depth", "m", 0, 4000, 9, true)};
}

// More points than are placed at once.
std::shared_ptr<const Grid> large() { return std::make_shared<const Grid>(space()); }
std::shared_ptr<const Grid> small() {
    auto axes = space();
    axes[0] = measuredAxis("lon", "degrees_east", 0, 350, 36);
    return std::make_shared<const Grid>(axes);
}

// While it lives nobody makes a globe of this grid.
class Held {
 public:
    explicit Held(const Grid& grid)
        : holder_([this, &grid] {
              grid.elsewhere(-1, [this]() -> std::shared_ptr<const timeseries::Mesh> {
                  begun_.set_value();
                  letGo_.get_future().wait();
                  return nullptr;
              });
          }) {
        begun_.get_future().wait();
    }
    ~Held() { letGo_.set_value(); }

 private:
    std::promise<void> begun_, letGo_;
    std::jthread holder_;
};

class ExplorationOfAGlobe : public testing::Test {
 protected:
    explicit ExplorationOfAGlobe(std::shared_ptr<const Grid> grid = large())
        : grid_(std::move(grid)), desk_({{"a", {.grid = grid_}}, {"b", {}}}) {
        desk_.open("a");
    }
    template <typename Change>
    void edit(const Change& change) {
        Explorer next = desk_.exploration.explorer();
        change(next);
        desk_.exploration.edit(next);
    }
    void choose(Map map) {
        edit([&](Explorer& e) { e.map = map; });
    }
    void stretch(double z) {
        edit([&](Explorer& e) { e.scale = glm::dvec3(1, 1, z); });
    }
    void untilOnGlobe() {
        desk_.until([&] { return shown().map == Map::Globe; });
    }
    const Explorer& shown() const { return desk_.exploration.shown()->explorer; }
    std::string waiting() const { return desk_.exploration.waiting(); }
    // Null while placing the points would make it.
    std::shared_ptr<const timeseries::Mesh> meshThere() const {
        const Grid& grid = desk_.exploration.shown()->sorted->grid();
        return render::globeOf(grid, shown().scale).meshIfMade(grid);
    }

    std::shared_ptr<const Grid> grid_;
    tests::ExplorationDesk desk_;
};

TEST_F(ExplorationOfAGlobe, WhileItIsMadeTheStepLiesFlatAndAllElseGoesOn) {
    {
        const Held held(*grid_);
        choose(Map::Globe);
        for (int frame = 0; frame < 3; ++frame) desk_.exploration.advance(16ms);
        EXPECT_EQ(desk_.exploration.explorer().map, Map::Globe);
        EXPECT_EQ(shown().map, Map::Flat);
        EXPECT_EQ(waiting(), "making the globe");
        edit([](Explorer& e) { e.layers = {layer("3:9")}; });
        EXPECT_EQ(shown().layers, desk_.exploration.explorer().layers);
        desk_.exploration.resize({320, 200});
        EXPECT_EQ(shown().size, glm::ivec2(320, 200));
        desk_.exploration.seek(7);
        desk_.untilShown(7);
        EXPECT_EQ(shown().steps, (StepChoice{7, 7}));
        EXPECT_EQ(shown().map, Map::Flat);
        EXPECT_EQ(meshThere(), nullptr);
    }
    untilOnGlobe();
    EXPECT_EQ(shown(), desk_.exploration.explorer());
    EXPECT_EQ(waiting(), "");
    ASSERT_TRUE(meshThere());
    EXPECT_EQ(*meshThere(), *render::Globe(Grid(space())).meshOf(Grid(space()))) << "as at once";
    // Steps of the same grid have the same.
    const auto mesh = meshThere();
    desk_.exploration.seek(2);
    desk_.untilShown(2);
    EXPECT_EQ(shown().map, Map::Globe);
    EXPECT_EQ(meshThere(), mesh);
    EXPECT_THAT(desk_.errors(), testing::IsEmpty());
}

TEST_F(ExplorationOfAGlobe, ChosenFlatAgainItIsMadeForNobody) {
    {
        const Held held(*grid_);
        choose(Map::Globe);
        choose(Map::Flat);
        EXPECT_EQ(waiting(), "");
        choose(Map::Globe);
        desk_.exploration.undo();
        EXPECT_EQ(shown(), desk_.exploration.explorer());
    }
    desk_.exploration.advance(16ms);
    EXPECT_EQ(shown().map, Map::Flat);
    desk_.exploration.redo();
    EXPECT_EQ(desk_.exploration.explorer().map, Map::Globe);
    untilOnGlobe();
    // And nobody holds it longer than it is looked at.
    choose(Map::Flat);
    const auto end = std::chrono::steady_clock::now() + 60s;  // the thread that made it has it, too
    while (render::Globe(*grid_).meshIfMade(*grid_) && std::chrono::steady_clock::now() < end)
        desk_.exploration.advance(16ms);
    EXPECT_EQ(render::Globe(*grid_).meshIfMade(*grid_), nullptr);
}

TEST_F(ExplorationOfAGlobe, OneStretchedOtherwiseStaysUntilTheOtherIsThere) {
    stretch(100);
    choose(Map::Globe);
    untilOnGlobe();
    const auto mesh = meshThere();
    {
        const Held held(*grid_);
        for (const double z : {150, 200, 300}) {
            stretch(z);
            desk_.exploration.advance(16ms);
            EXPECT_EQ(shown().map, Map::Globe);
            EXPECT_EQ(shown().scale, glm::dvec3(1, 1, 100));
            EXPECT_EQ(meshThere(), mesh);
            EXPECT_EQ(waiting(), "making the globe");
        }
    }
    desk_.until([&] { return shown().scale == glm::dvec3(1, 1, 300); });
    EXPECT_NE(meshThere(), mesh);
    EXPECT_EQ(waiting(), "");
}

TEST_F(ExplorationOfAGlobe, OtherDataOrTheEndDropIt) {
    const Held held(*grid_);
    choose(Map::Globe);
    desk_.choose("P");
    desk_.untilOpened();
    EXPECT_EQ(shown().variable, "P");
    EXPECT_EQ(shown().map, Map::Flat);
    desk_.open("b");
    EXPECT_EQ(desk_.exploration.explorer().map, Map::Flat);
    desk_.exploration.undo();
    desk_.untilOpened();
    EXPECT_EQ(desk_.exploration.explorer().map, Map::Globe);
}

class ExplorationOfASmallGlobe : public ExplorationOfAGlobe {
 protected:
    ExplorationOfASmallGlobe() : ExplorationOfAGlobe(small()) {}
};

TEST_F(ExplorationOfASmallGlobe, IsThereAtOnce) {
    choose(Map::Globe);
    EXPECT_EQ(shown().map, Map::Globe);
    EXPECT_EQ(waiting(), "");
    stretch(50);
    EXPECT_EQ(shown().scale, glm::dvec3(1, 1, 50));
    EXPECT_TRUE(meshThere());
}

// Places are told apart, their cells' volumes are not.
class ExplorationOfNoVolumes : public ExplorationOfAGlobe {
 protected:
    ExplorationOfNoVolumes()
        : ExplorationOfAGlobe(std::make_shared<const Grid>(
              std::array{measuredAxis("lon", "degrees_east", 0, 1e-170, 60),
                         measuredAxis("lat", "degrees_north", 0, 1e-170, 60), space()[2]})) {}
};

TEST_F(ExplorationOfNoVolumes, LieFlatAndSaySo) {
    choose(Map::Globe);
    EXPECT_EQ(desk_.exploration.explorer().map, Map::Globe);
    EXPECT_EQ(shown().map, Map::Flat);
    EXPECT_EQ(waiting(), "step 5 lies flat: none of its cells has a volume on a globe");
}

// Series some of whose steps have other grids.
class ExplorationOfGlobes : public testing::Test {
 protected:
    void open(const World& world) {
        desk_.emplace(std::map<std::string, World>{{"a", world}}, 1);  // a budget of one step
        desk_->open("a");
        Explorer next = desk_->exploration.explorer();
        next.map = Map::Globe;
        desk_->exploration.edit(next);
        desk_->until([&] { return shown().map == Map::Globe; });
        desk_->untilAllSeen();
    }
    const Explorer& shown() const { return desk_->exploration.shown()->explorer; }
    std::string waiting() const { return desk_->exploration.waiting(); }
    bool isLoaded(std::size_t step) const {
        return desk_->exploration.series()->state(step) == timeseries::SlotState::Loaded;
    }

    std::shared_ptr<const Grid> other_ = large();
    std::optional<tests::ExplorationDesk> desk_;
};

TEST_F(ExplorationOfGlobes, AStepWithAnotherGridIsShownOnceItsGlobeIsThere) {
    open({.grid = large(), .gridsOfSteps = {{6, other_}}});
    {
        const Held held(*other_);
        desk_->exploration.seek(6);
        desk_->until([&] { return isLoaded(6); });
        for (int frame = 0; frame < 3; ++frame) desk_->exploration.advance(16ms);
        EXPECT_EQ(desk_->shownStep(), 5u);
        EXPECT_EQ(shown().map, Map::Globe);
        EXPECT_EQ(waiting(), "making the globe of step 6, showing 5");
    }
    desk_->untilShown(6);
    EXPECT_EQ(shown().map, Map::Globe);
    EXPECT_EQ(waiting(), "");
}

TEST_F(ExplorationOfGlobes, AStepPassedByHandIsShownOnceItsGlobeIsThereWhereItIsNearer) {
    open({.grid = large(), .gridsOfSteps = {{6, other_}}});
    {
        const Held held(*other_);
        desk_->exploration.seek(6);
        desk_->until([&] { return isLoaded(6); });
        desk_->exploration.advance(16ms);
        desk_->script->hold();
        desk_->exploration.seek(9);
        desk_->exploration.advance(16ms);
        EXPECT_EQ(waiting(), "requested step 9, showing 5");
    }
    desk_->untilShown(6);
    EXPECT_EQ(shown().map, Map::Globe);
    desk_->script->letAllGo();
    desk_->untilShown(9);
    EXPECT_EQ(shown().map, Map::Globe);
}

TEST_F(ExplorationOfGlobes, AStepThatAGlobeCannotShowLiesFlatAndSaysSo) {
    auto beyond = space();
    beyond[1] = measuredAxis("lat", "degrees_north", -88, 100, 45);
    open({.grid = small(), .gridsOfSteps = {{7, std::make_shared<const Grid>(beyond)}}});
    desk_->exploration.seek(7);
    desk_->untilShown(7);
    EXPECT_EQ(shown().map, Map::Flat);
    EXPECT_EQ(
        waiting(),
        "step 7 lies flat: a globe is drawn of latitudes from -90 to 90, not from -88 to 100");
    // All else can be chosen.
    Explorer next = desk_->exploration.explorer();
    next.layers = {layer("3:9")};
    desk_->exploration.edit(next);
    EXPECT_EQ(shown().layers, next.layers);
    desk_->exploration.seek(2);
    desk_->untilShown(2);
    EXPECT_EQ(shown().map, Map::Globe);
    EXPECT_EQ(waiting(), "");
    EXPECT_THAT(desk_->errors(), testing::IsEmpty());
}

}  // namespace
}  // namespace app
