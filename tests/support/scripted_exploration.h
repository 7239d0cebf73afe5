// An Exploration of one scripted world, opened and shown.
#pragma once

#include "tests/support/exploration_desk.h"

namespace tests {

struct ScriptedExploration : ExplorationDesk {
    explicit ScriptedExploration(World made = {})
        : ExplorationDesk({{"world", made}}), world(std::move(made)) {
        open("world");
    }

    World world;
};

}  // namespace tests
