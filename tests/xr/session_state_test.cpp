#include "xr/session_state.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace xr {
namespace {

constexpr std::array kStates{State::Idle,    State::Ready,       State::Synchronized,
                             State::Visible, State::Focused,     State::Stopping,
                             State::Exiting, State::LossPending, State::Unknown};

// What the specification asks of the duties that were given so far, whatever the events.
struct Ledger {
    bool begun = false, over = false;

    // The duty that this event may bring, by the rules alone.
    Duty expected(State event) const {
        if (over) return Duty::None;
        if (event == State::Exiting) return Duty::Leave;
        if (event == State::LossPending) return Duty::Lost;
        if (event == State::Ready && !begun) return Duty::BeginSession;
        if (event == State::Stopping && begun) return Duty::EndSession;
        return Duty::None;
    }
    void note(Duty duty) {
        if (duty == Duty::BeginSession) begun = true;
        if (duty == Duty::EndSession) begun = false;
        if (duty == Duty::Leave || duty == Duty::Lost) over = true;
    }
};

std::string text(const std::vector<State>& events) {
    std::string out;
    for (const State s : events) out += " " + std::to_string(static_cast<int>(s));
    return out;
}

// Every continuation of `session` by up to `more` events.
void checkAll(const SessionState& session, const Ledger& ledger, std::vector<State>& events,
              int more) {
    if (more == 0) return;
    for (const State event : kStates) {
        SessionState next = session;
        Ledger told = ledger;
        events.push_back(event);
        const Duty duty = next.on(event);
        ASSERT_EQ(duty, ledger.expected(event)) << "after events" << text(events);
        told.note(duty);
        ASSERT_EQ(next.running(), told.begun && !told.over) << "after events" << text(events);
        const bool shown = event == State::Visible || event == State::Focused;
        ASSERT_EQ(next.visible(), next.running() && shown) << "after events" << text(events);
        ASSERT_EQ(next.focused(), next.running() && event == State::Focused)
            << "after events" << text(events);
        checkAll(next, told, events, more - 1);
        if (testing::Test::HasFatalFailure()) return;
        events.pop_back();
    }
}

TEST(SessionState, KeepsTheRulesInEverySequenceOfSixEvents) {
    std::vector<State> events;
    checkAll({}, {}, events, 6);
}

TEST(SessionState, GoesThroughALifeAsTheSpecificationTellsIt) {
    SessionState session;
    EXPECT_EQ(session.on(State::Idle), Duty::None);
    EXPECT_EQ(session.on(State::Ready), Duty::BeginSession);
    EXPECT_TRUE(session.running());
    EXPECT_FALSE(session.visible());
    EXPECT_EQ(session.on(State::Synchronized), Duty::None);
    EXPECT_EQ(session.on(State::Visible), Duty::None);
    EXPECT_TRUE(session.visible());
    EXPECT_EQ(session.on(State::Focused), Duty::None);
    EXPECT_TRUE(session.focused());
    EXPECT_EQ(session.on(State::Visible), Duty::None);
    EXPECT_EQ(session.on(State::Synchronized), Duty::None);
    EXPECT_EQ(session.on(State::Stopping), Duty::EndSession);
    EXPECT_FALSE(session.running());
    EXPECT_EQ(session.on(State::Idle), Duty::None);
    EXPECT_EQ(session.on(State::Ready), Duty::BeginSession);  // put on again
    EXPECT_EQ(session.on(State::Stopping), Duty::EndSession);
    EXPECT_EQ(session.on(State::Exiting), Duty::Leave);
    EXPECT_EQ(session.state(), State::Exiting);
}

}  // namespace
}  // namespace xr
