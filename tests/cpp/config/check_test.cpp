#include "netsim/config/check.hpp"

#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Check, AtLeastIncludesTheBound) {
    EXPECT_NO_THROW(check_at_least("radio.tx_power_w", 0, 0, "W"));
    EXPECT_EQ(error_text([] { check_at_least("radio.tx_power_w", -0.5, 0, "W"); }),
              "radio.tx_power_w = -0.5 W: expected at least 0 W");
}

TEST(Check, GreaterExcludesTheBound) {
    EXPECT_NO_THROW(check_greater("medium.alpha", 1e-300, 0, ""));
    EXPECT_EQ(error_text([] { check_greater("medium.alpha", 0, 0, ""); }),
              "medium.alpha = 0: expected more than 0");
}

TEST(Check, BetweenIncludesBothBounds) {
    EXPECT_NO_THROW(check_between("mac.mtu_bytes", 29, 29, 2304, "B"));
    EXPECT_NO_THROW(check_between("mac.mtu_bytes", 2304, 29, 2304, "B"));
    EXPECT_EQ(error_text([] { check_between("mac.mtu_bytes", 2305, 29, 2304, "B"); }),
              "mac.mtu_bytes = 2305 B: expected from 29 B to 2304 B");
    EXPECT_THROW(check_between("mac.mtu_bytes", 28, 29, 2304, "B"), ConfigError);
}

TEST(Check, NothingAcceptsNanOrInfinity) {
    for (const double value : {nan, infinity, -infinity}) {
        EXPECT_THROW(check_at_least("a", value, 0, ""), ConfigError) << value;
        EXPECT_THROW(check_greater("a", value, 0, ""), ConfigError) << value;
        EXPECT_THROW(check_between("a", value, 0, 1, ""), ConfigError) << value;
        EXPECT_THROW(check_finite("a", value, ""), ConfigError) << value;
    }
    EXPECT_EQ(error_text([] { check_finite("node.initial_position.x", nan, "m"); }),
              "node.initial_position.x = nan m: expected a finite number");
}

TEST(Check, NameOffersTheTableAndTheNearest) {
    constexpr std::array<std::string_view, 2> names{"FreeSpacePathLoss", "BreakpointPathLoss"};
    EXPECT_NO_THROW(check_name("medium.path_loss", "BreakpointPathLoss", names));
    EXPECT_EQ(
        error_text([&] { check_name("medium.path_loss", "freespacepathloss", names); }),
        "medium.path_loss = \"freespacepathloss\": expected one of FreeSpacePathLoss, BreakpointPathLoss; "
        "did you mean FreeSpacePathLoss?");
}

TEST(Check, NoNameIsShownAndNeverMeant) {
    constexpr std::array<std::string_view, 2> names{"", "SimpleFrameCapture"};
    EXPECT_NO_THROW(check_name("radio.frame_capture", "", names));
    EXPECT_EQ(error_text([&] { check_name("radio.frame_capture", "on", names); }),
              "radio.frame_capture = \"on\": expected one of \"\" (none), SimpleFrameCapture; did you mean "
              "SimpleFrameCapture?");
}

TEST(Check, NameFromATableOfOne) {
    constexpr std::array<std::string_view, 1> names{"IsotropicAntenna"};
    EXPECT_EQ(error_text([&] { check_name("radio.antenna", "Dipole", names); }),
              "radio.antenna = \"Dipole\": expected IsotropicAntenna");
}

TEST(Check, TextOfANumberIsTheShortestThatReadsBack) {
    EXPECT_EQ(text_of(0.02), "0.02");
    EXPECT_EQ(text_of(1e-14), "1e-14");
    EXPECT_EQ(text_of(1e300), "1e+300");
}

TEST(Check, TextOfAWholeNumberHasAllItsDigits) {
    EXPECT_EQ(text_of(0), "0");
    EXPECT_EQ(text_of(-1), "-1");
    EXPECT_EQ(text_of(5500000), "5500000");
}

}  // namespace
}  // namespace netsim
