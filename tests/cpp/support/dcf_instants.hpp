// Constants of the tests of the Dcf: the instants are computed by hand from the durations and
// intervals of IEEE 802.11 in this file.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "support/air.hpp"

namespace netsim::test {

// No backoff: every wait is an interframe space.
inline MacConfig without_backoff() {
    MacConfig config;
    config.cw_min = 0;
    config.cw_max = 0;
    return config;
}

inline MacConfig mac_of(const char* op_mode, double bitrate_bps) {
    MacConfig config;
    config.op_mode = op_mode;
    config.bitrate_bps = bitrate_bps;
    return config;
}

// g(mixed) at 24 Mbps, a payload of 100 B.
constexpr SimTime slot = us(20);
constexpr SimTime sifs = us(10);
constexpr SimTime difs = us(50);
constexpr SimTime eifs = us(364);
constexpr SimTime data_duration = us(82);
constexpr SimTime ack_duration = us(34);
constexpr SimTime ack_timeout = us(55);

inline std::vector<Heard> of_kind(const Sniffer& sniffer, FrameKind kind) {
    std::vector<Heard> frames;
    std::copy_if(sniffer.heard.begin(), sniffer.heard.end(), std::back_inserter(frames),
                 [kind](const Heard& heard) { return heard.kind == kind; });
    return frames;
}

}  // namespace netsim::test
