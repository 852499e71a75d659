#include "netsim/mac/frame_octets_802154.hpp"

#include <memory>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "netsim/mac/checksums.hpp"
#include "netsim/mac/frame_802154.hpp"

namespace netsim {
namespace {

Frame data_frame(NodeId receiver, bool asks_for_ack) {
    Frame frame;
    frame.kind = receiver == broadcast_id ? FrameKind::broadcast : FrameKind::unicast;
    frame.transmitter = 3;
    frame.receiver = receiver;
    frame.sequence = 0x1234;
    frame.duration_field = asks_for_ack ? SimTime::from_us(544) : SimTime();
    frame.payload = std::make_shared<const std::string>("hello");
    frame.psdu_bytes = narrowband_psdu_bytes(5);
    return frame;
}

Octets octets_of(const Frame& frame, bool intact = true) {
    Octets octets;
    append_narrowband_frame(octets, frame, intact);
    return octets;
}

Octets first(const Octets& octets, std::size_t count) {
    return {octets.begin(), octets.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(NarrowbandFrameOctets, AUnicastAsksForAnAck) {
    const Octets octets = octets_of(data_frame(0x0102, true));
    EXPECT_EQ(first(octets, 8), (Octets{0x21, 0x08, 0x34, 0x01, 0x00, 0x02, 0x01, 0x45}));
    EXPECT_EQ(octets.size(), 42U);
}

TEST(NarrowbandFrameOctets, AUnicastWithoutAckDoesNot) {
    EXPECT_EQ(first(octets_of(data_frame(0x0102, false)), 2), (Octets{0x01, 0x08}));
}

TEST(NarrowbandFrameOctets, ABroadcastGoesToTheBroadcastAddress) {
    EXPECT_EQ(first(octets_of(data_frame(broadcast_id, false)), 7),
              (Octets{0x01, 0x08, 0x34, 0x01, 0x00, 0xff, 0xff}));
}

TEST(NarrowbandFrameOctets, AnAckHasFiveOctets) {
    const Octets octets = octets_of(make_narrowband_ack(data_frame(1, true)));
    EXPECT_EQ(first(octets, 3), (Octets{0x02, 0x00, 0x34}));
    EXPECT_EQ(octets.size(), 5U);
}

TEST(NarrowbandFrameOctets, TheCheckSequenceOfAFrameWithItIsZero) {
    EXPECT_EQ(narrowband_check_sequence(octets_of(data_frame(1, true))), 0);
    EXPECT_NE(narrowband_check_sequence(octets_of(data_frame(1, true), false)), 0);
}

}  // namespace
}  // namespace netsim
