#include "netsim/node/computer.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/node/protocol_error.hpp"
#include "support/recorder.hpp"

namespace netsim {
namespace {

using test::Recorder;
using Told = Recorder::Told;

SimTime ms(double milliseconds) {
    return SimTime::from_seconds(milliseconds / 1e3);
}

// A node whose computer takes 1 ms for each event.
class ComputerTest : public testing::Test {
protected:
    void SetUp() override {
        NodeConfig config("node");
        config.mobility.telemetry_interval_s = 0;
        config.computer.processing_time_s = 1e-3;
        node = &test::add_recorder(network, config);
    }
    void run() {
        network.initialize();
        network.run_until(ms(1000));
    }

    Network network{MediumConfig(), 1};
    Recorder* node = nullptr;
};

TEST_F(ComputerTest, EventsWaitInOrder) {
    node->on_initialize = [](Recorder& self) {
        self.node.schedule_timer("one", ms(10));
        self.node.schedule_timer("two", ms(10));
        self.node.schedule_timer("late", ms(20));
    };
    run();
    EXPECT_EQ(node->timers, (std::vector<Told>{{ms(11), "one"}, {ms(12), "two"}, {ms(21), "late"}}));
}

TEST_F(ComputerTest, ATimerCanceledWhileItWaitsIsDropped) {
    node->on_initialize = [](Recorder& self) {
        self.node.schedule_timer("one", ms(10));
        self.node.schedule_timer("two", ms(10));
        self.node.schedule_timer("three", ms(10));
    };
    node->on_timer = [](Recorder& self, const std::string&) { self.node.cancel_timer("two"); };
    run();
    EXPECT_EQ(node->timers, (std::vector<Told>{{ms(11), "one"}, {ms(12), "three"}}));
}

TEST_F(ComputerTest, GoesOnAfterAnError) {
    node->on_initialize = [](Recorder& self) {
        self.node.schedule_timer("one", ms(10));
        self.node.schedule_timer("two", ms(10));
    };
    node->on_timer = [](Recorder&, const std::string& timer) {
        if (timer == "one") {
            throw std::runtime_error("broken");
        }
    };
    EXPECT_THROW(run(), ProtocolError);
    network.run_until(ms(1000));
    EXPECT_EQ(node->timer_names(), (std::vector<std::string>{"one", "two"}));
}

TEST_F(ComputerTest, FinishIsCalledAtOnce) {
    node->on_initialize = [](Recorder& self) { self.node.schedule_timer("late", ms(999.5)); };
    run();
    network.finish();
    EXPECT_EQ(node->timers, (std::vector<Told>{}));
    EXPECT_EQ(node->finished, (std::vector<Told>{{ms(1000), ""}}));
}

}  // namespace
}  // namespace netsim
