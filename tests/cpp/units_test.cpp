#include "netsim/units.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(Units, RatioFromDb) {
    EXPECT_DOUBLE_EQ(ratio_from_db(0), 1);
    EXPECT_DOUBLE_EQ(ratio_from_db(30), 1000);
    EXPECT_DOUBLE_EQ(ratio_from_db(4), 2.5118864315095801);
}

TEST(Units, DbFromRatio) {
    EXPECT_DOUBLE_EQ(db_from_ratio(1), 0);
    EXPECT_DOUBLE_EQ(db_from_ratio(0.01), -20);
}

TEST(Units, WattsFromDbm) {
    EXPECT_DOUBLE_EQ(w_from_dbm(0), 1e-3);
    EXPECT_DOUBLE_EQ(w_from_dbm(-110), 1e-14);
    EXPECT_DOUBLE_EQ(w_from_dbm(-85), 3.1622776601683794e-12);
}

TEST(Units, DbmFromWatts) {
    EXPECT_DOUBLE_EQ(dbm_from_w(1), 30);
    EXPECT_DOUBLE_EQ(dbm_from_w(0.02), 13.010299956639812);
}

TEST(Units, NoPowerIsMinusInfinityInDbm) {
    EXPECT_EQ(dbm_from_w(0), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(w_from_dbm(-std::numeric_limits<double>::infinity()), 0);
}

TEST(Units, DbmRoundTrip) {
    for (int step = 0; step <= 300; ++step) {
        const double power_dbm = -150 + 0.7 * step;
        EXPECT_NEAR(dbm_from_w(w_from_dbm(power_dbm)), power_dbm, 1e-12);
    }
}

}  // namespace
}  // namespace netsim
