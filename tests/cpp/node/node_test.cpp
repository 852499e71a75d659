#include "netsim/node/node.hpp"

#include <cstdint>
#include <exception>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "netsim/node/protocol_error.hpp"
#include "support/recorder.hpp"

namespace netsim {
namespace {

using test::Recorder;
using Told = Recorder::Told;

SimTime s(double seconds) {
    return SimTime::from_seconds(seconds);
}

template <typename Call>
std::string error_of(Call call) {
    try {
        call();
    } catch (const SimulationError& error) {
        return error.what();
    }
    return "no error";
}

// Two nodes 10 m apart.
class NodeTest : public testing::Test {
protected:
    void SetUp() override {
        NodeConfig config("first");
        config.mobility.telemetry_interval_s = 0;
        first = &test::add_recorder(network, config);
        config.name = "second";
        config.initial_position = {10, 0, 0};
        second = &test::add_recorder(network, config);
    }
    void run(double seconds = 100) {
        network.initialize();
        network.run_until(s(seconds));
    }

    Network network{MediumConfig(), 1};
    Recorder* first = nullptr;
    Recorder* second = nullptr;
};

TEST_F(NodeTest, KnowsItsNameIdAndPlace) {
    EXPECT_EQ(second->node.id(), 1);
    EXPECT_EQ(second->node.name(), "second");
    EXPECT_EQ(second->node.position(), (Position{10, 0, 0}));
}

TEST_F(NodeTest, ATimerIsDueAtItsTime) {
    first->on_initialize = [](Recorder& self) { self.node.schedule_timer("tick", s(2.5)); };
    run();
    EXPECT_EQ(first->timers, (std::vector<Told>{{s(2.5), "tick"}}));
}

TEST_F(NodeTest, TimersGoByTimeAndThenInTheOrderOfScheduling) {
    first->on_initialize = [](Recorder& self) {
        self.node.schedule_timer("late", s(3));
        self.node.schedule_timer("one", s(1));
        self.node.schedule_timer("two", s(1));
    };
    run();
    EXPECT_EQ(first->timer_names(), (std::vector<std::string>{"one", "two", "late"}));
}

TEST_F(NodeTest, EqualNamesMayBePendingSeveralTimes) {
    first->on_initialize = [](Recorder& self) {
        for (const double seconds : {1.0, 2.0, 2.0}) {
            self.node.schedule_timer("tick", s(seconds));
        }
    };
    run();
    EXPECT_EQ(first->timers, (std::vector<Told>{{s(1), "tick"}, {s(2), "tick"}, {s(2), "tick"}}));
}

TEST_F(NodeTest, ATimerMayBeDueNow) {
    first->on_timer = [](Recorder& self, const std::string& timer) {
        if (timer == "first") {
            self.node.schedule_timer("at once", self.node.now());
        }
    };
    first->on_initialize = [](Recorder& self) { self.node.schedule_timer("first", s(1)); };
    run();
    EXPECT_EQ(first->timers, (std::vector<Told>{{s(1), "first"}, {s(1), "at once"}}));
}

TEST_F(NodeTest, ATimerInThePastIsAnErrorThatNamesBothTimes) {
    run(2);
    EXPECT_EQ(error_of([this] { first->node.schedule_timer("tick", s(1.5)); }),
              "timer 'tick' at 1.500000 s is in the past: it is 2.000000 s now (timers take absolute "
              "simulated time)");
}

TEST_F(NodeTest, TimersForNowWithoutEndAreAnError) {
    first->on_initialize = [](Recorder& self) { self.node.schedule_timer("tick", s(1)); };
    first->on_timer = [](Recorder& self, const std::string&) {
        self.node.schedule_timer("tick", self.node.now());
    };
    EXPECT_EQ(error_of([this] { run(2); }),
              "node 0 has set 1000000 timers for now, 1.000000 s, and this one, 'tick', is one more: time "
              "stands still; expected a later time (timers take absolute simulated time: current_time() + 1, "
              "not 1)");
}

TEST_F(NodeTest, CancelTakesAllTimersOfTheName) {
    first->on_initialize = [](Recorder& self) {
        self.node.schedule_timer("tick", s(1));
        self.node.schedule_timer("tock", s(2));
        self.node.schedule_timer("tick", s(3));
        self.node.cancel_timer("tick");
    };
    run();
    EXPECT_EQ(first->timer_names(), std::vector<std::string>{"tock"});
}

TEST_F(NodeTest, CancellingATimerThatIsNotPendingIsFine) {
    first->on_initialize = [](Recorder& self) { self.node.cancel_timer("never set"); };
    EXPECT_NO_THROW(run());
}

TEST_F(NodeTest, ATimerCanCancelItsNamesakesFromItsOwnCallback) {
    first->on_initialize = [](Recorder& self) {
        for (const double seconds : {1.0, 1.0, 2.0}) {
            self.node.schedule_timer("tick", s(seconds));
        }
    };
    first->on_timer = [](Recorder& self, const std::string& timer) { self.node.cancel_timer(timer); };
    run();
    EXPECT_EQ(first->timers, (std::vector<Told>{{s(1), "tick"}}));
}

TEST_F(NodeTest, ATimerCanBeSetAgainAfterItWasCancelled) {
    first->on_initialize = [](Recorder& self) {
        self.node.schedule_timer("tick", s(1));
        self.node.cancel_timer("tick");
        self.node.schedule_timer("tick", s(2));
    };
    run();
    EXPECT_EQ(first->timers, (std::vector<Told>{{s(2), "tick"}}));
}

TEST_F(NodeTest, TimersBelongToTheirNode) {
    first->on_initialize = [](Recorder& self) { self.node.schedule_timer("tick", s(1)); };
    second->on_initialize = [](Recorder& self) {
        self.node.schedule_timer("tick", s(2));
        self.node.cancel_timer("tick");
    };
    run();
    EXPECT_EQ(first->timers.size(), 1U);
    EXPECT_TRUE(second->timers.empty());
}

TEST_F(NodeTest, ManyTimersComeAndGo) {
    int due = 0;
    first->on_initialize = [](Recorder& self) { self.node.schedule_timer("0", s(0)); };
    first->on_timer = [&due](Recorder& self, const std::string&) {
        if (++due < 1000) {
            self.node.schedule_timer(std::to_string(due), self.node.now() + s(0.001));
            self.node.schedule_timer("doomed", s(50));
        }
        self.node.cancel_timer("doomed");
    };
    run();
    EXPECT_EQ(due, 1000);
    EXPECT_EQ(first->timers.back().text, "999");
}

TEST_F(NodeTest, AMessageToAnUnknownNodeIsAnErrorThatNamesThoseThatExist) {
    EXPECT_EQ(error_of([this] { first->send(2, "text"); }), "cannot send to node 2: nodes are 0 … 1");
    EXPECT_EQ(error_of([this] { first->send(-1, "text"); }), "cannot send to node -1: nodes are 0 … 1");
}

TEST_F(NodeTest, AMessageToItselfIsAnError) {
    EXPECT_EQ(error_of([this] { first->send(0, "text"); }), "node 0 cannot send a message to itself");
}

TEST_F(NodeTest, AMessageWithoutAPayloadIsAnError) {
    EXPECT_EQ(error_of([this] { first->node.broadcast(nullptr); }),
              "node 0 cannot send nothing: the payload is null");
    EXPECT_EQ(error_of([this] { first->node.send(1, nullptr); }),
              "node 0 cannot send nothing: the payload is null");
}

TEST_F(NodeTest, AnErrorOfTheStandardLibraryInItsProtocolDoesSoToo) {
    first->on_initialize = [](Recorder&) { std::ignore = std::map<int, int>().at(3); };
    try {
        network.initialize();
        FAIL() << "no error";
    } catch (const ProtocolError& error) {
        EXPECT_STREQ(error.what(), "map::at");
        EXPECT_STREQ(error.callback(), "initialize");
        EXPECT_THROW(std::rethrow_if_nested(error), std::out_of_range);
    }
}

TEST_F(NodeTest, AnErrorOfItsProtocolKnowsItsPlaceInTheRun) {
    first->on_initialize = [](Recorder& self) { self.node.schedule_timer("late", s(1)); };
    first->on_timer = [](Recorder& self, const std::string&) { self.send(0, "hello"); };
    network.initialize();
    try {
        network.run_until(s(2));
        FAIL() << "no error";
    } catch (const ProtocolError& error) {
        EXPECT_STREQ(error.what(), "node 0 cannot send a message to itself");
        EXPECT_EQ(error.node(), 0);
        EXPECT_STREQ(error.callback(), "handle_timer");
        EXPECT_EQ(error.time(), s(1));
    }
}

TEST_F(NodeTest, GoesWhereItIsSent) {
    first->node.set_speed(2);
    first->node.go_to({0, 100, 0});
    run(10);
    EXPECT_NEAR(first->node.position().y, 20, 1e-9);
}

TEST(NodeObserved, IsToldOfBeforeItsProtocolIs) {
    Network network{MediumConfig(), 1};
    NodeConfig config("observed");
    config.initial_position = {1, 2, 3};
    config.mobility.telemetry_interval_s = 0.5;
    Recorder& recorder = test::add_recorder(network, config);
    std::vector<std::string> order;
    recorder.node.observe(
        [&](const Position& position) {
            EXPECT_EQ(position, (Position{1, 2, 3}));
            order.push_back("position at " + std::to_string(recorder.node.now().ps()));
        },
        [&](std::string_view name, const TrackedValue& value) {
            order.push_back(std::string(name) + " = " + std::to_string(std::get<std::int64_t>(value)));
        });
    recorder.on_telemetry = [](Recorder& self) {
        self.node.tracked_variables().set("telemetries", static_cast<std::int64_t>(self.telemetry.size()));
    };
    network.initialize();
    network.run_until(s(1));
    EXPECT_EQ(order, (std::vector<std::string>{"position at 500000000000", "telemetries = 1",
                                               "position at 1000000000000", "telemetries = 2"}));
}

}  // namespace
}  // namespace netsim
