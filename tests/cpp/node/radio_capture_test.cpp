#include "netsim/node/radio_capture.hpp"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "netsim/node/network.hpp"
#include "support/recorder.hpp"
#include "support/temporary_file.hpp"

namespace netsim {
namespace {

using test::Recorder;
using test::TemporaryFile;

struct Captured {
    std::int64_t ns = 0;
    bool sent = false;
    bool bad_fcs = false;
    unsigned frame_control = 0;
    std::size_t frame_bytes = 0;
};

std::uint32_t le32(const Octets& octets, std::size_t offset) {
    return octets[offset] | octets[offset + 1] << 8 | octets[offset + 2] << 16 |
           std::uint32_t{octets[offset + 3]} << 24;
}

std::vector<Captured> packets(const TemporaryFile& file) {
    const Octets octets = file.content();
    std::vector<Captured> result;
    std::size_t offset = 24;
    while (offset < octets.size()) {
        const std::size_t length = le32(octets, offset + 8);
        const std::size_t packet = offset + 16;
        const std::size_t radiotap_bytes = octets[packet + 2];
        result.push_back({std::int64_t{le32(octets, offset)} * 1'000'000'000 + le32(octets, offset + 4),
                          radiotap_bytes == 15, (octets[packet + 8] & 0x40) != 0,
                          octets[packet + radiotap_bytes], length - radiotap_bytes});
        offset = packet + length;
    }
    return result;
}

// Two nodes, 0.1 light microseconds apart.
class RadioCaptureTest : public testing::Test {
protected:
    static NodeConfig at(double x) {
        NodeConfig config("node" + std::to_string(static_cast<int>(x)));
        config.initial_position = {x, 0, 0};
        config.mobility.telemetry_interval_s = 0;
        return config;
    }

    void run() {
        network.initialize();
        network.run_until(SimTime::from_seconds(1));
        network.finish();
    }

    Network network{MediumConfig(), 1};
    Recorder& sender = test::add_recorder(network, at(0));
    Recorder& receiver = test::add_recorder(network, at(29.9792458));
};

TEST_F(RadioCaptureTest, AMessageAndItsAckAtBothEnds) {
    const TemporaryFile at_sender;
    const TemporaryFile at_receiver;
    sender.on_initialize = [](Recorder& self) { self.send(1, "hello"); };
    network.capture(0, at_sender.path());
    network.capture(1, at_receiver.path());
    run();
    const std::vector<Captured> here = packets(at_sender);
    const std::vector<Captured> there = packets(at_receiver);
    ASSERT_EQ(here.size(), 2U);
    ASSERT_EQ(there.size(), 2U);
    EXPECT_TRUE(here[0].sent && there[1].sent);
    EXPECT_FALSE(here[1].sent || there[0].sent);
    EXPECT_EQ(here[0].frame_control, 0x08U);
    EXPECT_EQ(here[1].frame_control, 0xd4U);
    EXPECT_EQ(here[0].frame_bytes, 69U);
    EXPECT_EQ(here[1].frame_bytes, 14U);
    // A message of 69 B at 24 Mbps lasts 50 µs with its signal extension; SIFS is 10 µs.
    EXPECT_EQ(there[0].ns - here[0].ns, 100);
    EXPECT_EQ(here[1].ns - there[1].ns, 100);
    EXPECT_EQ(there[1].ns - there[0].ns, 60'000);
}

TEST_F(RadioCaptureTest, WhatFailedIsFlagged) {
    const TemporaryFile file;
    NodeConfig far = at(29.9792458);
    far.name = "far";
    far.wlan[0].radio.snir_threshold = 1e12;  // locks on to every frame and decodes none
    network.add_node(far);
    sender.on_initialize = [](Recorder& self) { self.broadcast("hello"); };
    network.capture(2, file.path());
    run();
    const std::vector<Captured> captured = packets(file);
    ASSERT_EQ(captured.size(), 1U);
    EXPECT_TRUE(captured[0].bad_fcs);
    EXPECT_EQ(captured[0].frame_bytes, 69U);
}

TEST_F(RadioCaptureTest, FramesMissedWhileTransmittingAreNotThere) {
    const TemporaryFile file;
    sender.on_initialize = receiver.on_initialize = [](Recorder& self) {
        self.node.schedule_timer("both", SimTime::from_us(5000));
    };
    sender.on_timer = receiver.on_timer = [](Recorder& self, const std::string&) { self.broadcast("hello"); };
    network.capture(0, file.path());
    run();
    const std::vector<Captured> captured = packets(file);
    ASSERT_EQ(captured.size(), 1U);
    EXPECT_TRUE(captured[0].sent);
}

TEST_F(RadioCaptureTest, NothingIsCapturedAfterTheEnd) {
    const TemporaryFile file;
    network.capture(0, file.path());
    network.close_captures();
    sender.on_initialize = [](Recorder& self) { self.broadcast("hello"); };
    run();
    EXPECT_TRUE(packets(file).empty());
}

TEST_F(RadioCaptureTest, ItDoesNotChangeTheRun) {
    const TemporaryFile file;
    Network other(MediumConfig(), 1);
    const auto talk = [](Recorder& self) { self.send(1 - self.node.id(), "hello"); };
    for (const double x : {0.0, 29.9792458}) {
        test::add_recorder(other, at(x)).on_initialize = talk;
    }
    sender.on_initialize = receiver.on_initialize = talk;
    network.capture(0, file.path());
    run();
    other.initialize();
    other.run_until(SimTime::from_seconds(1));
    EXPECT_EQ(network.fingerprint(), other.fingerprint());
    EXPECT_EQ(network.event_count(), other.event_count());
}

TEST_F(RadioCaptureTest, OneCaptureForEachNode) {
    const TemporaryFile file;
    network.capture(0, file.path());
    EXPECT_THROW(network.capture(0, file.path()), ConfigError);
}

TEST_F(RadioCaptureTest, APathThatCannotBeWrittenLeavesNoCapture) {
    const TemporaryFile file;
    EXPECT_THROW(network.capture(0, "no/such/folder/a.pcap"), ConfigError);
    EXPECT_NO_THROW(network.capture(0, file.path()));
}

TEST(RadioCapture, AUnitDiskMediumHasNoRadios) {
    const TemporaryFile file;
    Network network(MediumConfig("UnitDiskRadioMedium"), 1);
    network.add_node(NodeConfig("uavs[0]"));
    try {
        network.capture(0, file.path());
        FAIL();
    } catch (const ConfigError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "cannot capture the frames of uavs[0]: medium.typename = \"UnitDiskRadioMedium\" has no "
                  "radios; expected Ieee80211ScalarRadioMedium or another radio medium");
    }
}

}  // namespace
}  // namespace netsim
