#include "app/choices/choices.h"

#include <gmock/gmock.h>

#include <set>

#include "app/choices/sweep_edits.h"
#include "tests/support/random_explorer.h"

namespace app {
namespace {

TEST(Choices, AreSpelledOnceEach) {
    std::set<std::string> options, keys;
    for (const Choice& choice : choices()) {
        const bool isNew = *choice.key == '\0' || keys.insert(choice.key).second;
        EXPECT_TRUE(isNew) << choice.key;
        if (*choice.option == '\0') {
            EXPECT_STRNE(choice.key, "");
            continue;
        }
        EXPECT_TRUE(options.insert(choice.option).second) << choice.option;
        EXPECT_STRNE(choice.group, "") << choice.option;
        EXPECT_STRNE(choice.help, "") << choice.option;
    }
}

TEST(Choices, TakenFromTheirTextsAreTheSame) {
    tests::RandomExplorer random(5);
    for (int i = 0; i < 300; ++i) {
        const Explorer e = random();
        Explorer copy;
        for (const Choice& choice : choices())
            if (const auto text = choice.text(e)) choice.take(copy, *text);
        // What is spelled elsewhere.
        copy.files = e.files;
        copy.layers = e.layers;
        copy.noLayers = e.noLayers;
        EXPECT_EQ(copy, e) << i;
    }
}

TEST(Choices, WhatCannotStandTogetherIsNamed) {
    const auto keyOf = [](const Explorer& e) {
        const auto flaw = flawOf(e);
        return flaw ? flaw->key : "";
    };
    Explorer e;
    EXPECT_EQ(keyOf(e), "");
    setSweep(e, {.animation = timeseries::RangeSet::parse("0:9")});
    e.layers.resize(render::kMaxLayers);
    EXPECT_EQ(keyOf(e), "");
    e.layers.emplace_back();
    EXPECT_EQ(keyOf(e), "layers") << "the swept one counts";
    e.layers.resize(1);
    e.oneTick = true;
    e.play.tick = ticksOf(*sweepOf(e)) - 1;
    EXPECT_EQ(keyOf(e), "");
    ++e.play.tick;
    EXPECT_EQ(keyOf(e), "sweep.tick");
    e.oneTick = false;
    e.play.time.last = e.play.time.first = 3;
    EXPECT_EQ(keyOf(e), "");
    e.play.time.last = 2;
    EXPECT_EQ(keyOf(e), "play.last");
}

}  // namespace
}  // namespace app
