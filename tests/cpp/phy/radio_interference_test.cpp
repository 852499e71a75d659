// Frames that overlap with a locked frame: when they count, and which nodes are interferers.
#include <map>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/phy/radio.hpp"
#include "support/radio_among_senders.hpp"

namespace netsim {
namespace {

using test::BareRadio;
using test::sensitivity_w;
using test::strong_w;
using test::us;

// A signal with an SNIR of 5 for one interferer and of 2.5 for two, which is below the
// threshold.
class PartialOverlap : public test::RadioAmongSenders {
protected:
    void SetUp() override {
        RadioConfig config;
        config.snir_threshold = 3;
        receiver = &add_receiver(config);
        arrives(add_sender(strong_w), us(100), us(100));
        one = &add_sender(strong_w / 5);
        other = &add_sender(strong_w / 5);
    }
    FrameOutcome outcome() {
        air.run();
        for (const FrameOutcome outcome :
             {FrameOutcome::delivered, FrameOutcome::interference, FrameOutcome::noise}) {
            if (air.frame_outcomes.counts_at(receiver->id(),
                                             FrameKind::broadcast)[static_cast<std::size_t>(outcome)] == 1) {
                return outcome;
            }
        }
        return FrameOutcome::in_air;
    }

    BareRadio* receiver = nullptr;
    BareRadio* one = nullptr;
    BareRadio* other = nullptr;
};

TEST_F(PartialOverlap, OneInterfererIsBearable) {
    arrives(*one, us(150), us(100));
    EXPECT_EQ(outcome(), FrameOutcome::delivered);
}

TEST_F(PartialOverlap, TwoAtOnceAreNot) {
    arrives(*one, us(120), us(50));
    arrives(*other, us(150), us(50));
    EXPECT_EQ(outcome(), FrameOutcome::interference);
}

TEST_F(PartialOverlap, OnePicosecondOfBothIsEnough) {
    arrives(*one, us(120), us(30) + SimTime::from_ps(1));
    arrives(*other, us(150), us(30));
    EXPECT_EQ(outcome(), FrameOutcome::interference);
}

TEST_F(PartialOverlap, OneAfterTheOtherIsBearable) {
    arrives(*one, us(120), us(30));
    arrives(*other, us(150), us(30));
    EXPECT_EQ(outcome(), FrameOutcome::delivered);
}

TEST_F(PartialOverlap, BothAtOnceAfterTheFrameAreNoMatter) {
    arrives(*one, us(180), us(100));
    arrives(*other, us(200), us(100));
    EXPECT_EQ(outcome(), FrameOutcome::delivered);
}

TEST_F(PartialOverlap, BothAreNamed) {
    arrives(*one, us(120), us(50));
    arrives(*other, us(150), us(50));
    air.run();
    EXPECT_EQ(air.frame_outcomes.interferers_at(receiver->id()),
              (std::map<NodeId, std::uint64_t>{{one->id(), 1}, {other->id(), 1}}));
}

TEST_F(PartialOverlap, OnlyThoseOfTheWorstMomentAreNamed) {
    BareRadio& loud = add_sender(strong_w);
    arrives(*one, us(120), us(20));
    arrives(loud, us(150), us(20));
    air.run();
    EXPECT_EQ(air.frame_outcomes.interferers_at(receiver->id()),
              (std::map<NodeId, std::uint64_t>{{loud.id(), 1}}));
}

TEST_F(PartialOverlap, ASenderOfTwoFramesIsNamedOnce) {
    BareRadio& loud = add_sender(strong_w);
    arrives(loud, us(120), us(20));
    arrives(loud, us(150), us(20));
    air.run();
    EXPECT_EQ(air.frame_outcomes.interferers_at(receiver->id()),
              (std::map<NodeId, std::uint64_t>{{loud.id(), 1}}));
}

// Interferers below sensitivity, before a frame that touches or overlaps them.
class TouchingFrames : public test::RadioAmongSenders {
protected:
    void SetUp() override {
        RadioConfig config;
        config.sensitivity_w = sensitivity_w;
        receiver = &add_receiver(config);
        arrives(add_sender(1.1 * sensitivity_w), us(100), us(100));
        hidden = &add_sender(0.9 * sensitivity_w);
    }
    BareRadio* receiver = nullptr;
    BareRadio* hidden = nullptr;
};

TEST_F(TouchingFrames, EndingAsTheFrameStartsIsNoOverlap) {
    arrives(*hidden, us(50), us(50));
    air.run();
    EXPECT_EQ(air.broadcast_count_at(*receiver, FrameOutcome::delivered), 1U);
}

TEST_F(TouchingFrames, StartingAsTheFrameEndsIsNoOverlap) {
    arrives(*hidden, us(200), us(50));
    air.run();
    EXPECT_EQ(air.broadcast_count_at(*receiver, FrameOutcome::delivered), 1U);
}

TEST_F(TouchingFrames, APicosecondMoreIsOne) {
    arrives(*hidden, us(50), us(50) + SimTime::from_ps(1));
    air.run();
    EXPECT_EQ(air.broadcast_count_at(*receiver, FrameOutcome::interference), 1U);
}

// A weak interferer, with an SNIR of 5.
class CollisionModel : public test::RadioAmongSenders {
protected:
    std::uint64_t received(std::string_view model, double interferer_w) {
        RadioConfig config;
        config.sensitivity_w = sensitivity_w;
        config.collision_model = model;
        BareRadio& receiver = add_receiver(config);
        arrives(add_sender(strong_w), us(100), us(100));
        arrives(add_sender(interferer_w), us(150), us(100));
        air.run();
        return receiver.log.received_from.size();
    }
};

TEST_F(CollisionModel, BySnirWeakInterferenceIsBearable) {
    EXPECT_EQ(received("snir", strong_w / 5), 1U);
}

TEST_F(CollisionModel, ByOverlapItIsNot) {
    EXPECT_EQ(received("overlap", strong_w / 5), 0U);
}

TEST_F(CollisionModel, ByOverlapInterferenceBelowTheSensitivityIsBearable) {
    EXPECT_EQ(received("overlap", sensitivity_w * 0.9), 1U);
}

}  // namespace
}  // namespace netsim
