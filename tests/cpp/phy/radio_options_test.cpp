// The radio with preamble detection, frame capture and SNIR by chunks, each off by default.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/phy/radio.hpp"
#include "netsim/units.hpp"
#include "support/air.hpp"

namespace netsim {
namespace {

using test::Air;
using test::BareRadio;
using test::light_microsecond_m;
using test::RadioWord;
using test::us;

constexpr double strong_w = 1e-10;

// A receiver whose frames come from a microsecond away; only energy far above them makes its
// channel busy.
class RadioOptions : public testing::Test {
protected:
    RadioOptions() { config.energy_detection_w = 1; }

    BareRadio& receiver() {
        if (receiver_ == nullptr) {
            receiver_ = &air.add_radio({0, 0, 0}, config);
        }
        return *receiver_;
    }
    // A frame of a separate sender is at the receiver from `start` for `duration`.
    NodeId arrives(double received_w, SimTime start, SimTime duration = us(200)) {
        receiver();
        constexpr Position directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
        BareRadio& sender =
            air.add_radio(directions[senders_++] * light_microsecond_m,
                          test::radio_of_power(test::power_for(received_w, light_microsecond_m)));
        air.at(start - us(1), [&sender, duration] { sender.send(duration); });
        return sender.id();
    }
    std::uint64_t count(FrameOutcome outcome) { return air.broadcast_count_at(receiver(), outcome); }

    RadioConfig config;
    Air air;

private:
    BareRadio* receiver_ = nullptr;
    std::size_t senders_ = 0;
};

class RadioWithPreambleDetection : public RadioOptions {
protected:
    RadioWithPreambleDetection() { config.preamble_detection = "ThresholdPreambleDetection"; }
};

TEST_F(RadioWithPreambleDetection, ReceivesAFrameAlone) {
    const NodeId sender = arrives(strong_w, us(100));
    air.run();
    EXPECT_EQ(receiver().log.received_from, std::vector{sender});
}

TEST_F(RadioWithPreambleDetection, IsBusyFromTheDetectionOn) {
    arrives(strong_w, us(100));
    air.run();
    EXPECT_EQ(receiver().log.times_of(RadioWord::busy), std::vector{us(104)});
    EXPECT_EQ(receiver().log.times_of(RadioWord::free), std::vector{us(300)});
}

TEST_F(RadioWithPreambleDetection, EnergyTooIsSensedOnlyThen) {
    config.energy_detection_w = strong_w / 2;
    config.preamble_minimum_power_w = 2 * strong_w;
    arrives(strong_w, us(100));
    air.run();
    EXPECT_EQ(receiver().log.times_of(RadioWord::busy), std::vector{us(104)});
    EXPECT_EQ(receiver().log.times_of(RadioWord::free), std::vector{us(300)});
}

TEST_F(RadioWithPreambleDetection, AChannelBusyByEnergyStaysSo) {
    config.energy_detection_w = strong_w / 2;
    config.preamble_minimum_power_w = 2 * strong_w;
    arrives(strong_w, us(100));
    arrives(strong_w, us(200));
    air.run();
    EXPECT_EQ(receiver().log.times_of(RadioWord::busy), std::vector{us(104)});
    EXPECT_EQ(receiver().log.times_of(RadioWord::free), std::vector{us(400)});
}

TEST_F(RadioWithPreambleDetection, TheMinimumPowerIsNeeded) {
    config.preamble_minimum_power_w = 1.001 * strong_w;
    arrives(strong_w, us(100));
    air.run();
    EXPECT_EQ(count(FrameOutcome::preamble_undetected), 1U);
    EXPECT_TRUE(receiver().log.events.empty());
}

TEST_F(RadioWithPreambleDetection, TheThresholdIsNeededOverOthers) {
    arrives(2.4 * strong_w, us(100));
    arrives(strong_w, us(101));
    air.run();
    EXPECT_EQ(count(FrameOutcome::preamble_undetected), 2U);
    EXPECT_TRUE(receiver().log.events.empty());
}

TEST_F(RadioWithPreambleDetection, OfTwoAtOnceTheStrongerIsReceived) {
    arrives(strong_w, us(100));
    const NodeId strong = arrives(100 * strong_w, us(103));
    air.run();
    EXPECT_EQ(receiver().log.received_from, std::vector{strong});
    EXPECT_EQ(count(FrameOutcome::preamble_undetected), 1U);
}

TEST_F(RadioWithPreambleDetection, OfTwoOfEqualPowerTheFirstIsDetected) {
    config.preamble_threshold = 0.5;
    arrives(strong_w, us(100), us(10));
    arrives(strong_w, us(101), us(10));
    air.run();
    EXPECT_EQ(count(FrameOutcome::receiver_locked), 1U);
    EXPECT_EQ(count(FrameOutcome::preamble_undetected), 0U);
}

TEST_F(RadioWithPreambleDetection, WhatIsStillListenedToAtADetectionIsLost) {
    const NodeId strong = arrives(100 * strong_w, us(100));
    arrives(strong_w, us(103));
    air.run();
    EXPECT_EQ(receiver().log.received_from, std::vector{strong});
    EXPECT_EQ(count(FrameOutcome::receiver_locked), 1U);
}

// The SNIR at the end of the detection counts.
TEST_F(RadioWithPreambleDetection, WhatEndsDuringItDoesNoHarm) {
    config.sensitivity_w = 2 * strong_w;
    arrives(3 * strong_w, us(100));
    arrives(1.9 * strong_w, us(50), us(52));
    air.run();
    EXPECT_EQ(count(FrameOutcome::interference), 1U);  // detected, and lost afterwards
}

TEST_F(RadioWithPreambleDetection, AFrameShorterThanTheDetectionIsUndetected) {
    config.preamble_duration_s = 1e-3;
    arrives(strong_w, us(100));
    air.run();
    EXPECT_EQ(count(FrameOutcome::preamble_undetected), 1U);
}

TEST_F(RadioWithPreambleDetection, StartingToTransmitGivesItUp) {
    arrives(strong_w, us(100));
    arrives(strong_w, us(101));
    air.at(us(102), [&] { receiver().send(us(50)); });
    air.run();
    EXPECT_EQ(count(FrameOutcome::receiver_transmitting), 2U);
}

class RadioWithFrameCapture : public RadioOptions {
protected:
    RadioWithFrameCapture() { config.frame_capture = "SimpleFrameCapture"; }
};

TEST_F(RadioWithFrameCapture, AStrongerFrameTakesThePlaceOfAnother) {
    arrives(strong_w, us(100));
    const NodeId strong = arrives(100 * strong_w, us(110));
    air.run();
    EXPECT_EQ(receiver().log.received_from, std::vector{strong});
    EXPECT_EQ(count(FrameOutcome::captured), 1U);
    EXPECT_EQ(receiver().log.times_of(RadioWord::corrupted), std::vector{us(110)});
    EXPECT_EQ(receiver().log.times_of(RadioWord::busy), std::vector{us(100)});
}

TEST_F(RadioWithFrameCapture, NotAfterTheWindow) {
    arrives(strong_w, us(100));
    arrives(100 * strong_w, us(117));
    air.run();
    EXPECT_EQ(count(FrameOutcome::receiver_locked), 1U);
    EXPECT_EQ(count(FrameOutcome::interference), 1U);
}

TEST_F(RadioWithFrameCapture, WithPreambleDetectionTheNewcomerHasToBeDetected) {
    config.preamble_detection = "ThresholdPreambleDetection";
    const NodeId strong = (arrives(strong_w, us(100)), arrives(100 * strong_w, us(110)));
    air.run();
    EXPECT_EQ(receiver().log.received_from, std::vector{strong});
    EXPECT_EQ(receiver().log.times_of(RadioWord::busy), (std::vector{us(104), us(114)}));
}

class RadioWithChunks : public RadioOptions {
protected:
    RadioWithChunks() { config.snir_mode = "chunks"; }
};

TEST_F(RadioWithChunks, ReceivesAFrameAlone) {
    const NodeId sender = arrives(strong_w, us(100));
    air.run();
    EXPECT_EQ(receiver().log.received_from, std::vector{sender});
}

TEST_F(RadioWithChunks, WithoutItsHeaderAFrameIsGivenUpAtOnce) {
    arrives(strong_w, us(100));
    arrives(100 * strong_w, us(116), us(4));
    air.run();
    EXPECT_EQ(count(FrameOutcome::header_error), 1U);
    EXPECT_EQ(receiver().log.times_of(RadioWord::corrupted), std::vector{us(120)});
    EXPECT_TRUE(receiver().log.corrupted.front().header_lost);
    EXPECT_EQ(receiver().log.times_of(RadioWord::free), std::vector{us(120)});
}

TEST_F(RadioWithChunks, AfterALostHeaderTheEnergyOfOthersKeepsTheChannelBusy) {
    config.preamble_detection = "ThresholdPreambleDetection";
    config.energy_detection_w = strong_w / 2;
    arrives(strong_w, us(100));
    arrives(100 * strong_w, us(110));
    air.run();
    EXPECT_EQ(count(FrameOutcome::header_error), 1U);
    EXPECT_EQ(receiver().log.times_of(RadioWord::free), std::vector{us(310)});
}

TEST_F(RadioWithChunks, InterferenceWithThePreambleAloneDoesNoHarm) {
    const NodeId sender = arrives(strong_w, us(100));
    arrives(100 * strong_w, us(101), us(15));
    air.run();
    EXPECT_EQ(receiver().log.received_from, std::vector{sender});
}

TEST_F(RadioWithChunks, InterferenceWithTheDataIsBlamed) {
    arrives(strong_w, us(100));
    const NodeId other = arrives(100 * strong_w, us(150), us(20));
    air.run();
    EXPECT_EQ(count(FrameOutcome::interference), 1U);
    EXPECT_EQ(air.frame_outcomes.interferers_at(receiver().id()),
              (std::map<NodeId, std::uint64_t>{{other, 1}}));
}

// Interference only during the header, so strong that about half of the headers survive it.
TEST_F(RadioWithChunks, AHeaderThatSurvivedIsNotDecidedAgain) {
    constexpr unsigned frames = 200;
    config.snir_threshold = 0;
    BareRadio& here = receiver();
    BareRadio& sender = air.add_radio({light_microsecond_m, 0, 0},
                                      test::radio_of_power(test::power_for(strong_w, light_microsecond_m)));
    BareRadio& other =
        air.add_radio({0, light_microsecond_m, 0},
                      test::radio_of_power(test::power_for(0.7 * strong_w, light_microsecond_m)));
    std::vector<SimTime> header_ends;
    for (unsigned i = 0; i < frames; ++i) {
        const SimTime start = us(1000) * (i + 1);
        air.at(start, [&] { sender.send(us(200)); });
        air.at(start + us(16), [&] { other.send(us(4)); });
        header_ends.push_back(start + us(1 + 20));
    }
    air.run();
    const std::vector<SimTime> corrupted = here.log.times_of(RadioWord::corrupted);
    EXPECT_GT(corrupted.size(), frames / 4);
    EXPECT_LT(corrupted.size(), frames);
    EXPECT_TRUE(std::ranges::includes(header_ends, corrupted));
}

TEST_F(RadioWithChunks, AFrameThatEndsWithItsHeaderIsDecided) {
    arrives(strong_w, us(100), us(18));
    air.run();
    EXPECT_EQ(count(FrameOutcome::delivered), 1U);
}

// A frame whose header is lost to a stronger one, which goes on.
class RadioThatLosesAHeader : public RadioOptions {
protected:
    RadioThatLosesAHeader() {
        config.preamble_detection = "ThresholdPreambleDetection";
        config.snir_mode = "chunks";
        config.energy_detection_w = strong_w / 2;
        config.lost_header_frees_channel = true;
        arrives(strong_w, us(100));
    }
    std::vector<SimTime> times_free() { return receiver().log.times_of(RadioWord::free); }
};

TEST_F(RadioThatLosesAHeader, TakesTheChannelToBeFree) {
    arrives(100 * strong_w, us(110));
    air.run();
    EXPECT_EQ(count(FrameOutcome::header_error), 1U);
    EXPECT_EQ(times_free(), std::vector{us(120)});
}

TEST_F(RadioThatLosesAHeader, SensesWhatBeganWithinTheHeader) {
    arrives(100 * strong_w, us(117));
    air.run();
    EXPECT_EQ(count(FrameOutcome::header_error), 1U);
    EXPECT_EQ(times_free(), std::vector{us(317)});
}

TEST_F(RadioThatLosesAHeader, SensesAllOnceItHasListenedToAnotherFrame) {
    arrives(100 * strong_w, us(110));
    arrives(strong_w, us(200), us(10));
    air.run();
    EXPECT_EQ(receiver().log.times_of(RadioWord::busy), (std::vector{us(104), us(204)}));
    EXPECT_EQ(times_free(), (std::vector{us(120), us(310)}));
}

TEST_F(RadioThatLosesAHeader, SensesAllIfAFrameBeginsWhileItTransmits) {
    arrives(100 * strong_w, us(110));
    arrives(strong_w, us(160), us(10));
    air.at(us(150), [this] { receiver().send(us(20)); });
    air.run();
    EXPECT_EQ(times_free(), (std::vector{us(120), us(310)}));
}

TEST(RadioNoise, ThermalNoiseIsAPropertyOfTheReceiver) {
    MediumConfig medium;
    medium.background_noise = "ThermalNoise";
    Air air(medium);
    RadioConfig config;
    config.snir_threshold = 1000;
    config.sensitivity_w = 1e-14;
    BareRadio& quiet = air.add_radio({0, 0, 0}, config);
    config.noise_figure = 100;
    BareRadio& noisy = air.add_radio({0, 0, 0}, config);
    BareRadio& sender =
        air.add_radio({100, 0, 0}, test::radio_of_power(test::power_for(w_from_dbm(-60), 100)));
    air.at(us(10), [&] { sender.send(us(200)); });
    air.run();
    EXPECT_EQ(air.broadcast_count_at(quiet, FrameOutcome::delivered), 1U);
    EXPECT_EQ(air.broadcast_count_at(noisy, FrameOutcome::noise), 1U);
}

// A receiver whose frames are lost only below 3 dB, and other systems that change each 100 µs.
class RadioAmongOtherSystems : public testing::Test {
protected:
    static MediumConfig medium() {
        MediumConfig medium;
        medium.background_noise_w = 1e-12;
        medium.other_systems_w = 1e-12;
        medium.other_systems_standard_deviation_db = 6;
        medium.other_systems_coherence_time_s = 1e-4;
        return medium;
    }
    static RadioConfig receiver_config(const char* snir_mode) {
        RadioConfig config;
        config.error_model = "";
        config.snir_threshold = 2;
        config.sensitivity_w = 1e-15;
        config.energy_detection_w = 1;
        config.snir_mode = snir_mode;
        return config;
    }
    // How many of 300 frames of 250 µs are received, and how many had a SNR above 2 throughout the part that is decided.
    void compare(const char* snir_mode, SimTime first, SimTime last) {
        constexpr double received_w = 6e-12;
        Air air(medium());
        BareRadio& receiver = air.add_radio({0, 0, 0}, receiver_config(snir_mode));
        BareRadio& sender =
            air.add_radio(Position{1, 0, 0} * light_microsecond_m,
                          test::radio_of_power(test::power_for(received_w, light_microsecond_m)));
        std::uint64_t expected = 0;
        constexpr int count = 300;
        for (int i = 0; i < count; ++i) {
            const SimTime start = us(1000 * i + 37);
            air.at(start - us(1), [&sender] { sender.send(us(250), 90); });
            const double most_w = air.medium.other_systems().max_w(receiver.radio.interface().stream(),
                                                                   start + first, start + last);
            expected += received_w / (1e-12 + most_w) > 2 ? 1 : 0;
        }
        air.run();
        EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::delivered), expected);
        EXPECT_EQ(air.broadcast_count_at(receiver, FrameOutcome::noise) +
                      air.broadcast_count_at(receiver, FrameOutcome::header_error),
                  count - expected);
        EXPECT_GT(expected, 20U);
        EXPECT_LT(expected, 280U);
    }
};

TEST_F(RadioAmongOtherSystems, TheWorstMomentDecides) {
    compare("min", us(0), us(250));
}

// The preamble of 16 µs does not count.
TEST_F(RadioAmongOtherSystems, EachIntervalDecidesByChunks) {
    compare("chunks", us(16), us(250));
}

}  // namespace
}  // namespace netsim
