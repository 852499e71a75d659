#include "netsim/mac/frame_octets.hpp"

#include <memory>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "netsim/mac/checksums.hpp"

namespace netsim {
namespace {

Frame data_frame(NodeId transmitter, NodeId receiver, const std::string& text) {
    Frame frame;
    frame.kind = receiver == broadcast_id ? FrameKind::broadcast : FrameKind::unicast;
    frame.transmitter = transmitter;
    frame.receiver = receiver;
    frame.psdu_bytes = data_psdu_bytes(static_cast<int>(text.size()));
    frame.payload = std::make_shared<const std::string>(text);
    return frame;
}

Octets octets_of(const Frame& frame, bool intact = true) {
    Octets octets;
    append_frame(octets, frame, intact);
    return octets;
}

Octets part(const Octets& octets, std::size_t offset, std::size_t length) {
    const auto part = std::span(octets).subspan(offset, length);
    return Octets(part.begin(), part.end());
}

TEST(FrameOctets, OfADataFrame) {
    Frame frame = data_frame(1, 2, "hello");
    frame.sequence = 5;
    frame.retry = true;
    frame.duration_field = SimTime::from_ns(44'200);
    EXPECT_EQ(octets_of(frame), (Octets{
                                    0x08, 0x08,                                      // data, retry
                                    0x2d, 0x00,                                      // 45 µs
                                    0x02, 0x00, 0x00, 0x00, 0x00, 0x02,              // receiver
                                    0x02, 0x00, 0x00, 0x00, 0x00, 0x01,              // transmitter
                                    0x02, 0xff, 0xff, 0xff, 0xff, 0xff,              // BSS
                                    0x50, 0x00,                                      // sequence number 5
                                    0xaa, 0xaa, 0x03, 0x00, 0x00, 0x00, 0x08, 0x00,  // LLC/SNAP: IPv4
                                    0x45, 0x00, 0x00, 0x21,                          // 33 octets
                                    0x00, 0x05, 0x00, 0x00,                          // identification 5
                                    0x40, 0x11, 0x66, 0xc5,                          // 64 hops, UDP, checksum
                                    0x0a, 0x00, 0x00, 0x01,                          // 10.0.0.1
                                    0x0a, 0x00, 0x00, 0x02,                          // 10.0.0.2
                                    0xc3, 0x50, 0xc3, 0x50,                          // ports 50000
                                    0x00, 0x0d, 0x21, 0x5e,                          // 13 octets, checksum
                                    'h',  'e',  'l',  'l',  'o',                     //
                                    0xa8, 0xc1, 0x0a, 0x05                           // FCS
                                }));
}

TEST(FrameOctets, OfAnAck) {
    Frame ack;
    ack.kind = FrameKind::ack;
    ack.transmitter = 2;
    ack.receiver = 1;
    ack.psdu_bytes = ack_bytes;
    EXPECT_EQ(octets_of(ack),
              (Octets{0xd4, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x00, 0x01, 0xd8, 0xd6, 0xbf, 0x8f}));
}

TEST(FrameOctets, OfAnRts) {
    Frame rts;
    rts.kind = FrameKind::rts;
    rts.transmitter = 2;
    rts.receiver = 1;
    rts.duration_field = SimTime::from_us(300);
    rts.psdu_bytes = rts_bytes;
    EXPECT_EQ(part(octets_of(rts), 0, 16), (Octets{0xb4, 0x00, 0x2c, 0x01, 0x02, 0x00, 0x00, 0x00, 0x00, 0x01,
                                                   0x02, 0x00, 0x00, 0x00, 0x00, 0x02}));
}

TEST(FrameOctets, OfACts) {
    Frame cts;
    cts.kind = FrameKind::cts;
    cts.transmitter = 2;
    cts.receiver = 1;
    cts.duration_field = SimTime::from_us(300);
    cts.psdu_bytes = cts_bytes;
    EXPECT_EQ(part(octets_of(cts), 0, 10),
              (Octets{0xc4, 0x00, 0x2c, 0x01, 0x02, 0x00, 0x00, 0x00, 0x00, 0x01}));
}

TEST(FrameOctets, ABroadcastIsForAll) {
    const Octets octets = octets_of(data_frame(1, broadcast_id, "hello"));
    EXPECT_EQ(part(octets, 4, 6), Octets(6, 0xff));
    EXPECT_EQ(part(octets, 48, 4), Octets(4, 0xff));
}

TEST(FrameOctets, AddressesHoldThreeOctetsOfTheNode) {
    const Octets octets = octets_of(data_frame(0x12345, 0x0abcde, ""));
    EXPECT_EQ(part(octets, 4, 12),
              (Octets{0x02, 0x00, 0x00, 0x0a, 0xbc, 0xde, 0x02, 0x00, 0x00, 0x01, 0x23, 0x45}));
    EXPECT_EQ(part(octets, 44, 8), (Octets{0x0a, 0x01, 0x23, 0x45, 0x0a, 0x0a, 0xbc, 0xde}));
}

TEST(FrameOctets, TheFcsOfALostFrameIsInverted) {
    const Frame frame = data_frame(1, 2, "hello");
    const Octets intact = octets_of(frame);
    const Octets lost = octets_of(frame, false);
    const std::size_t body = intact.size() - fcs_bytes;
    EXPECT_EQ(part(lost, 0, body), part(intact, 0, body));
    for (std::size_t i = body; i < intact.size(); ++i) {
        EXPECT_EQ(lost[i] ^ intact[i], 0xff);
    }
}

TEST(FrameOctets, AnIntactFrameLeavesTheResidueOfItsFcs) {
    EXPECT_EQ(frame_check_sequence(octets_of(data_frame(1, 2, "hello"))), 0x2144df1cU);
}

TEST(FrameOctets, TheChecksumsHoldForEveryLength) {
    for (std::size_t length = 0; length < 70; ++length) {
        const Octets octets = octets_of(data_frame(3, 4, std::string(length, 'x')));
        EXPECT_EQ(octets.size(), 64 + length);
        EXPECT_EQ(internet_checksum(std::span(octets).subspan(32, 20)), 0);
        Octets covered = part(octets, 44, 8);
        append_be16(covered, 17);
        append_be16(covered, static_cast<unsigned>(8 + length));
        const Octets datagram = part(octets, 52, 8 + length);
        covered.insert(covered.end(), datagram.begin(), datagram.end());
        EXPECT_EQ(internet_checksum(covered), 0) << length;
    }
}

// A checksum of 0 would mean that there is none (RFC 768).
TEST(FrameOctets, AUdpChecksumOfZeroIsWrittenAsOnes) {
    EXPECT_EQ(part(octets_of(data_frame(1, 2, "e6")), 58, 2), (Octets{0xff, 0xff}));
}

TEST(FrameOctets, ALongSequenceKeepsTwelveBitsInTheFrameAndSixteenInTheDatagram) {
    Frame frame = data_frame(1, 2, "");
    frame.sequence = 0x54321;
    EXPECT_EQ(part(octets_of(frame), 22, 2), (Octets{0x10, 0x32}));
    EXPECT_EQ(part(octets_of(frame), 36, 2), (Octets{0x43, 0x21}));
}

TEST(FrameOctets, TheLongestDurationIs32767) {
    Frame frame = data_frame(1, 2, "");
    frame.duration_field = SimTime::from_us(40'000);
    EXPECT_EQ(part(octets_of(frame), 2, 2), (Octets{0xff, 0x7f}));
}

}  // namespace
}  // namespace netsim
