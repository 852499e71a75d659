// Fixture of the tests of the Dcf: two stations, and the frames on the air at the first.
#pragma once

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "support/air.hpp"
#include "support/dcf_instants.hpp"

namespace netsim::test {

// Two stations a light microsecond apart, and a sniffer at the first.
class DcfPair : public testing::Test {
protected:
    void add_pair(const MacConfig& mac) {
        a = &air.add_station({0, 0, 0}, mac);
        b = &air.add_station({light_microsecond_m, 0, 0}, mac);
        at_a = &air.add_sniffer({0, 0, 0});
    }
    // Station b receives a's frames, but its responses are too weak for a.
    void add_pair_without_way_back(const MacConfig& mac) {
        a = &air.add_station({0, 0, 0}, mac);
        b = &air.add_station({light_microsecond_m, 0, 0}, mac, radio_of_power(1e-6));
        at_a = &air.add_sniffer({0, 0, 0});
    }
    std::vector<SimTime> starts(FrameKind kind) const {
        std::vector<SimTime> times;
        for (const Heard& frame : of_kind(*at_a, kind)) {
            times.push_back(frame.start);
        }
        return times;
    }
    // Unicast messages, in both directions.
    std::uint64_t given_up() const {
        return air.message_count(MessageKind::unicast, MessageOutcome::retry_limit);
    }

    Air air;
    Station* a = nullptr;
    Station* b = nullptr;
    Sniffer* at_a = nullptr;
};

}  // namespace netsim::test
