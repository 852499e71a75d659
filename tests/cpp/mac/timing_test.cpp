#include "netsim/mac/timing.hpp"

#include <string_view>

#include <gtest/gtest.h>

namespace netsim {
namespace {

struct Expected {
    std::string_view op_mode;
    int slot_us, sifs_us, difs_us, eifs_us;
};

TEST(MacTiming, OfEachOperationMode) {
    // EIFS = SIFS + DIFS + ACK of 14 B at 1 Mbps (192 + 112 = 304 µs) or at 6 Mbps (20 + 6 * 4 = 44
    // µs, in g 50 µs).
    for (const Expected& expected : {Expected{"b", 20, 10, 50, 364}, Expected{"g(erp)", 9, 10, 28, 88},
                                     Expected{"g(mixed)", 20, 10, 50, 364}, Expected{"a", 9, 16, 34, 94}}) {
        const MacTiming timing(mode_set(expected.op_mode));
        EXPECT_EQ(timing.slot, SimTime::from_us(expected.slot_us)) << expected.op_mode;
        EXPECT_EQ(timing.sifs, SimTime::from_us(expected.sifs_us)) << expected.op_mode;
        EXPECT_EQ(timing.difs, SimTime::from_us(expected.difs_us)) << expected.op_mode;
        EXPECT_EQ(timing.eifs, SimTime::from_us(expected.eifs_us)) << expected.op_mode;
    }
}

TEST(MacTiming, ResponseTimeoutOfOfdmAndDsss) {
    const ModeSet& mixed = mode_set("g(mixed)");
    const MacTiming timing(mixed);
    EXPECT_EQ(timing.response_timeout(mixed.mode_for_bitrate(24e6)), SimTime::from_us(10 + 20 + 25));
    EXPECT_EQ(timing.response_timeout(mixed.mode_for_bitrate(11e6)), SimTime::from_us(10 + 20 + 192));
}

}  // namespace
}  // namespace netsim
