// An Exploration of one scripted world, opened and shown.
#pragma once

#include "app/exploration.h"
#include "tests/support/scripted_reader.h"

namespace tests {

struct ScriptedExploration {
    explicit ScriptedExploration(World made = {}) : world(std::move(made)) {
        exploration.open(std::vector<std::filesystem::path>{"world"});
        until([&] { return !exploration.opening(); });
    }
    // Frames in which no time passes, each after something came, until it holds.
    template <typename Condition>
    void until(const Condition& holds) {
        for (exploration.advance({}); !holds(); exploration.advance({})) script->waitForWake();
    }

    World world;
    std::shared_ptr<Script> script = std::make_shared<Script>();
    app::Exploration exploration{{.wake = [script = script] { script->wake(); },
                                  .openDataset =
                                      [this](auto named, const std::string& variable) {
                                          return scriptedDataset(world, script,
                                                                 named.front().string(), variable);
                                      }}};
};

}  // namespace tests
