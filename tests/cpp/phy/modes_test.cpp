// Durations are computed by hand from the formulas at the top of modes.hpp. For OFDM and n bytes:
// n = 14: 134 bits, 100: 822, 164: 1334, 1500: 12022; divided by N_DBPS and rounded up, times 4 µs,
// plus 20 µs. For DSSS and CCK n = 14: 112 bits, 100: 800, 164: 1312, 1500: 12000; divided by the
// bitrate and rounded up to µs, plus 192 µs.
#include "netsim/phy/modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "netsim/config/mac_config.hpp"

namespace netsim {
namespace {

constexpr std::array psdu_bytes{14, 100, 164, 1500};

struct Expected {
    double mbps;
    std::array<int, 4> duration_us;  // of psdu_bytes
};

constexpr std::array<Expected, 4> expected_dsss{{
    {1, {304, 992, 1504, 12192}},
    {2, {248, 592, 848, 6192}},
    {5.5, {213, 338, 431, 2374}},
    {11, {203, 265, 312, 1283}},
}};
constexpr std::array<Expected, 8> expected_ofdm{{
    {6, {44, 160, 244, 2024}},
    {9, {36, 112, 172, 1356}},
    {12, {32, 92, 132, 1024}},
    {18, {28, 68, 96, 688}},
    {24, {28, 56, 76, 524}},
    {36, {24, 44, 60, 356}},
    {48, {24, 40, 48, 272}},
    {54, {24, 36, 48, 244}},
}};

void expect_durations(const ModeSet& set, std::span<const Expected> expected, int signal_extension_us) {
    for (const Expected& mode : expected) {
        for (std::size_t i = 0; i < psdu_bytes.size(); ++i) {
            const SimTime duration = set.mode_for_bitrate(mode.mbps * 1e6).duration(psdu_bytes[i]);
            EXPECT_EQ(duration.ps(), (mode.duration_us[i] + signal_extension_us) * 1'000'000LL)
                << mode.mbps << " Mbps, " << psdu_bytes[i] << " B";
        }
    }
}

TEST(ModeDuration, OfB) {
    expect_durations(mode_set("b"), expected_dsss, 0);
}

TEST(ModeDuration, OfA) {
    expect_durations(mode_set("a"), expected_ofdm, 0);
}

TEST(ModeDuration, OfErpHasASignalExtension) {
    expect_durations(mode_set("g(erp)"), expected_ofdm, 6);
}

TEST(ModeDuration, OfMixedIsThatOfBAndErp) {
    expect_durations(mode_set("g(mixed)"), expected_dsss, 0);
    expect_durations(mode_set("g(mixed)"), expected_ofdm, 6);
}

TEST(ModeDuration, OfAnEmptyFrame) {
    EXPECT_EQ(mode_set("b").mode_for_bitrate(1e6).duration(0), SimTime::from_us(192));
    EXPECT_EQ(mode_set("a").mode_for_bitrate(24e6).duration(0),
              SimTime::from_us(24));  // service and tail: 22 bits
}

TEST(ModeDuration, WholeMicrosecondsAreNotRoundedUp) {
    EXPECT_EQ(mode_set("b").mode_for_bitrate(11e6).duration(11), SimTime::from_us(192 + 8));
    EXPECT_EQ(mode_set("b").mode_for_bitrate(5.5e6).duration(11), SimTime::from_us(192 + 16));
}

TEST(ModeDuration, OfTheLongestFrameDoesNotOverflow) {
    EXPECT_EQ(mode_set("b").mode_for_bitrate(1e6).duration(65535), SimTime::from_us(192 + 524280));
}

TEST(Mode, DataBitsIncludeServiceTailAndPaddingInOfdmOnly) {
    EXPECT_EQ(mode_set("a").mode_for_bitrate(24e6).data_bits(100), 864);  // 9 symbols of 96
    EXPECT_EQ(mode_set("b").mode_for_bitrate(11e6).data_bits(100), 800);
}

TEST(Mode, BitrateIsThatOfItsSymbols) {
    for (const Mode& mode : mode_set("a").modes()) {
        EXPECT_EQ(mode.bitrate_bps * 4, mode.data_bits_per_symbol * 1'000'000LL) << mode.name;
    }
}

TEST(ModeSet, TableHasAllNamesOfTheConfiguration) {
    for (const std::string_view name : op_mode_names) {
        EXPECT_EQ(mode_set(name).name(), name);
    }
}

// A station knows the formats of a mode of another set only if it has that mode: the formats
// determine what it can decode.
TEST(ModeSet, KnowsTheFormatsOfItsOwnModesOnly) {
    for (const std::string_view one : op_mode_names) {
        for (const std::string_view other : op_mode_names) {
            for (const Mode& mode : mode_set(other).modes()) {
                const auto own = mode_set(one).modes();
                const bool has_it = std::ranges::find(own, mode.name, &Mode::name) != own.end();
                EXPECT_EQ(mode_set(one).formats().contains(mode.format), has_it) << one << " " << mode.name;
            }
        }
    }
}

TEST(ModeSet, UnknownNameIsAnError) {
    EXPECT_EQ(error_text([] { mode_set("g(mix)"); }),
              "mac.op_mode = \"g(mix)\": expected one of b, g(erp), g(mixed), a; did you mean g(mixed)?");
}

TEST(ModeSet, MandatoryModes) {
    const auto mandatory = [](std::string_view name) {
        std::vector<double> mbps;
        for (const Mode& mode : mode_set(name).modes()) {
            if (mode.mandatory) {
                mbps.push_back(static_cast<double>(mode.bitrate_bps) / 1e6);
            }
        }
        return mbps;
    };
    EXPECT_EQ(mandatory("b"), (std::vector<double>{1, 2, 5.5, 11}));
    EXPECT_EQ(mandatory("g(erp)"), (std::vector<double>{6, 12, 24}));
    EXPECT_EQ(mandatory("g(mixed)"), (std::vector<double>{1, 2, 5.5, 6, 11, 12, 24}));
    EXPECT_EQ(mandatory("a"), (std::vector<double>{6, 12, 24}));
}

TEST(ModeSet, ModesRiseInBitrate) {
    for (const std::string_view name : op_mode_names) {
        std::int64_t last_bps = 0;
        for (const Mode& mode : mode_set(name).modes()) {
            EXPECT_GT(mode.bitrate_bps, last_bps) << name;
            last_bps = mode.bitrate_bps;
        }
    }
}

struct Intervals {
    std::string_view name;
    int slot_us, sifs_us, cw_min, cw_max;
};

TEST(ModeSet, IntervalsAndWindows) {
    for (const Intervals& expected :
         {Intervals{"b", 20, 10, 31, 1023}, Intervals{"g(erp)", 9, 10, 15, 1023},
          Intervals{"g(mixed)", 20, 10, 31, 1023}, Intervals{"a", 9, 16, 15, 1023}}) {
        const ModeSet& set = mode_set(expected.name);
        EXPECT_EQ(set.slot(), SimTime::from_us(expected.slot_us)) << expected.name;
        EXPECT_EQ(set.sifs(), SimTime::from_us(expected.sifs_us)) << expected.name;
        EXPECT_EQ(set.cw_min(), expected.cw_min) << expected.name;
        EXPECT_EQ(set.cw_max(), expected.cw_max) << expected.name;
    }
}

TEST(Mode, ReceiveStartDelayOfOfdmAndDsss) {
    const ModeSet& mixed = mode_set("g(mixed)");
    EXPECT_EQ(mixed.mode_for_bitrate(24e6).phy_rx_start_delay, SimTime::from_us(25));
    EXPECT_EQ(mixed.mode_for_bitrate(11e6).phy_rx_start_delay, SimTime::from_us(192));
}

TEST(ModeSet, MinusOneIsTheFastestMandatoryMode) {
    EXPECT_EQ(mode_set("b").mode_for_bitrate(-1).bitrate_bps, 11'000'000);
    EXPECT_EQ(mode_set("g(erp)").mode_for_bitrate(-1).bitrate_bps, 24'000'000);
    EXPECT_EQ(mode_set("g(mixed)").mode_for_bitrate(-1).bitrate_bps, 24'000'000);
    EXPECT_EQ(mode_set("a").mode_for_bitrate(-1).bitrate_bps, 24'000'000);
}

TEST(ModeSet, SlowestMandatoryMode) {
    EXPECT_EQ(mode_set("g(mixed)").slowest_mandatory().bitrate_bps, 1'000'000);
    EXPECT_EQ(mode_set("g(erp)").slowest_mandatory().bitrate_bps, 6'000'000);
}

TEST(ModeSet, UnknownBitrateIsAnErrorWithTheValidOnes) {
    EXPECT_EQ(error_text([] { mode_set("b").mode_for_bitrate(10e6); }),
              "mac.bitrate_bps = 10000000 bps: expected a bitrate of b, which has 1, 2, 5.5, 11 Mbps; the "
              "nearest is "
              "11 Mbps");
}

TEST(ModeSet, UnknownBitrateNamesTheFieldThatTheUserSet) {
    EXPECT_EQ(error_text([] { mode_set("a").mode_for_bitrate(std::nan(""), "mac.multicast_bitrate_bps"); }),
              "mac.multicast_bitrate_bps = nan bps: expected a bitrate of a, which has 6, 9, 12, 18, 24, 36, "
              "48, 54 "
              "Mbps; the nearest is 6 Mbps");
}

TEST(ModeSet, ResponseIsMandatoryAndNoFasterThanTheFrame) {
    const auto response_mbps = [](std::string_view name, double mbps) {
        const ModeSet& set = mode_set(name);
        return static_cast<double>(set.response_mode(set.mode_for_bitrate(mbps * 1e6)).bitrate_bps) / 1e6;
    };
    EXPECT_EQ(response_mbps("g(erp)", 54), 24);
    EXPECT_EQ(response_mbps("g(erp)", 24), 24);
    EXPECT_EQ(response_mbps("g(erp)", 18), 12);
    EXPECT_EQ(response_mbps("g(erp)", 9), 6);
    EXPECT_EQ(response_mbps("g(erp)", 6), 6);
    EXPECT_EQ(response_mbps("g(mixed)", 54), 24);
    EXPECT_EQ(response_mbps("g(mixed)", 18), 12);
    EXPECT_EQ(response_mbps("g(mixed)", 9), 6);
    EXPECT_EQ(response_mbps("g(mixed)", 5.5), 5.5);
    EXPECT_EQ(response_mbps("b", 11), 11);
}

// A station of set a receives a frame slower than all mandatory rates.
TEST(ModeSet, ResponseFallsBackToTheSlowestMandatoryMode) {
    EXPECT_EQ(mode_set("a").response_mode(mode_set("b").mode_for_bitrate(1e6)).bitrate_bps, 6'000'000);
}

}  // namespace
}  // namespace netsim
