// Expected numbers are independent of this code. They come from the formulas at the top of
// error_rate.hpp and spread_error_rate.hpp evaluated with 50 digits (mpmath: erfc, sqrt, exp, and the weight spectra as
// written there), from ns-3 3.44 and from INET 4.5.
#include "netsim/phy/error_rate.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/config/radio_config.hpp"
#include "netsim/error.hpp"
#include "netsim/units.hpp"
#include "support/error_model.hpp"

namespace netsim {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const Mode& mode(double mbps) {
    return mode_set("g(mixed)").mode_for_bitrate(mbps * 1e6);
}

const NistErrorModel& nist() {
    static const NistErrorModel model(inet_rates);
    return model;
}

double success(double mbps, double snir, int psdu_bytes) {
    return nist().success_probability(mode(mbps), snir, psdu_bytes);
}

struct Point {
    double mbps;
    double snir;
    int psdu_bytes;
    double success;
};

void expect_success(const std::vector<Point>& points) {
    for (const Point& point : points) {
        // 1e-11: erfc, exp and a thousand-fold product of their rounding errors.
        EXPECT_NEAR(success(point.mbps, point.snir, point.psdu_bytes) / point.success, 1, 1e-11)
            << point.mbps << " Mbps, SNIR " << point.snir << ", " << point.psdu_bytes << " B";
    }
}

TEST(NistErrorModel, OfdmSuccessIsThatOfTheFormulas) {
    expect_success({
        {6, 1.8, 100, 0.36836476603160388},
        {6, 1.95, 1000, 0.062474127353242915},
        {9, 4.0, 100, 0.89323332418151862},
        {9, 4.4, 1000, 0.75271097476893199},
        {12, 3.6, 100, 0.36836465332947866},
        {12, 3.9, 1000, 0.062474123816778605},
        {18, 8.0, 100, 0.88885919950857959},
        {18, 8.8, 1000, 0.75175272878244385},
        {24, 18.0, 100, 0.86016681904791238},
        {24, 19.5, 1000, 0.61668229993489551},
        {36, 38.0, 100, 0.90900957715276493},
        {36, 45.0, 1000, 0.91285044076768818},
        {48, 100.0, 100, 0.58459058165240049},
        {48, 130.0, 1000, 0.86864061955285487},
        {54, 160.0, 100, 0.95825386696340544},
        {54, 190.0, 1000, 0.95791174722652787},
        {6, 2.5, 14, 0.99862207727946565},
    });
}

TEST(NistErrorModel, DsssSuccessIsThatOfTheFormulas) {
    expect_success({
        {1, 3.5, 100, 0.67927710834570956},
        {1, 2.0, 100, 0.00040907643980990227},
        {2, 8.0, 100, 0.34755961371234152},
        {2, 11.0, 1000, 0.21144525539374197},
        {2, 5.0, 14, 0.33602205805145399},
    });
}

TEST(NistErrorModel, CckSuccessIsThatOfTheFits) {
    expect_success({
        {5.5, 2.5, 100, 0.39006790368381379},
        {5.5, 4.0, 100, 0.97692451689425873},
        {5.5, 9.9, 1000, 0.99999991843257381},
        {5.5, 0.05, 100, 4.1834668557952864e-254},
        {11, 5.0, 100, 0.16224729374902013},
        {11, 9.5, 100, 0.96729252464829364},
        {11, 0.05, 100, 4.1834668557952864e-254},
        {11, 10.5, 100, 0.99999998180185514},
    });
}

// A row of ns-3's table: the success of 8 · bytes bits in the frame's mode. A frame adds header,
// service field, tail and padding, which the tests omit.
struct Chunk {
    std::string mode;
    int psdu_bytes = 0;
    double snir_db = 0;
    double success = 0;
};

std::vector<Chunk> chunks_of_ns3() {
    std::ifstream file(NETSIM_REFERENCE_FOLDER "/ns3_error_model.csv");
    std::vector<Chunk> chunks;
    std::string line;
    std::getline(file, line);  // the header
    while (std::getline(file, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream cells(line);
        std::string model;
        Chunk chunk;
        cells >> model >> chunk.mode >> chunk.psdu_bytes >> chunk.snir_db >> chunk.success;
        chunks.push_back(chunk);
    }
    return chunks;
}

TEST(NistErrorModel, BitErrorsAreThoseOfNs3) {
    const std::map<std::string, double> mbps{
        {"ErpOfdmRate6Mbps", 6}, {"ErpOfdmRate24Mbps", 24}, {"DsssRate1Mbps", 1}};
    const NistErrorModel model(despreading_rates);
    const std::vector<Chunk> chunks = chunks_of_ns3();
    ASSERT_EQ(chunks.size(), 1014U);
    for (const Chunk& chunk : chunks) {
        const double bit_error =
            model.bit_error_rate(mode(mbps.at(chunk.mode)), ratio_from_db(chunk.snir_db));
        // Printed by ns-3 with 10 digits.
        EXPECT_NEAR(std::pow(1 - bit_error, 8 * chunk.psdu_bytes), chunk.success, 1e-9 * chunk.success)
            << chunk.mode << ", " << chunk.psdu_bytes << " B, " << chunk.snir_db << " dB";
    }
}

// 1998 broadcast frames of 100 B per point, on INET's radio with this SNIR (free space, 2.412 GHz,
// -110 dBm of noise): within 4 standard deviations of the binomial distribution.
TEST(NistErrorModel, ReceptionRatiosAreThoseOfInet) {
    struct Link {
        double mbps;
        double snir;
        int received;
    };
    for (const Link& link : {
             Link{24, 18.971242, 1851},
             Link{24, 16.057259, 989},
             Link{24, 14.845839, 276},
             Link{6, 2.1779538, 1879},
             Link{6, 1.9194295, 1376},
             Link{6, 1.7043455, 201},
             Link{1, 4.1429847, 1804},
             Link{1, 3.2083274, 989},
             Link{1, 2.7506236, 358},
         }) {
        constexpr double sent = 1998;
        const double expected = success(link.mbps, link.snir, 100);
        EXPECT_NEAR(link.received, sent * expected, 4 * std::sqrt(sent * expected * (1 - expected)))
            << link.mbps << " Mbps, SNIR " << link.snir;
    }
}

TEST(NistErrorModel, NothingIsDecodedWithoutSignal) {
    for (const Mode& each : mode_set("g(mixed)").modes()) {
        EXPECT_LT(nist().success_probability(each, 0, 100), 1e-250) << each.name;
    }
}

TEST(NistErrorModel, EverythingIsDecodedWithoutNoise) {
    for (const Mode& each : mode_set("g(mixed)").modes()) {
        EXPECT_EQ(nist().success_probability(each, infinity, 65535), 1) << each.name;
    }
}

TEST(NistErrorModel, BitErrorsAreAtMostOneAndFallWithTheSnir) {
    for (const Mode& each : mode_set("g(mixed)").modes()) {
        double last = 1;
        for (int step = 0; step < 1400; ++step) {
            const double snir_db = -30 + 0.05 * step;
            const double bit_error = nist().bit_error_rate(each, ratio_from_db(snir_db));
            EXPECT_LE(bit_error, last) << each.name << " at " << snir_db << " dB";
            EXPECT_GE(bit_error, 0) << each.name << " at " << snir_db << " dB";
            last = bit_error;
        }
    }
}

// Modes with a bound.
std::vector<Mode> bounded_modes() {
    std::vector<Mode> modes;
    for (const Mode& each : mode_set("g(mixed)").modes()) {
        if (nist().min_success(each, infinity, 100) > 0) {
            modes.push_back(each);
        }
    }
    return modes;
}

TEST(NistErrorModel, BoundsTheSuccessOfAllModesButCck) {
    EXPECT_EQ(bounded_modes().size(), 10U);
}

TEST(NistErrorModel, SuccessIsNeverBelowItsBoundAtThatSnirOrALargerOne) {
    for (const Mode& each : bounded_modes()) {
        for (const int psdu_bytes : {14, 164, 1536}) {
            double max_bound = 0;
            for (int step = 0; step < 23'037; ++step) {  // up to 1e4
                const double snir = 1e-6 * std::pow(1.001, step);
                max_bound = std::max(max_bound, nist().min_success(each, snir, psdu_bytes));
                EXPECT_GE(nist().success_probability(each, snir, psdu_bytes), max_bound)
                    << each.name << " at " << snir;
            }
        }
    }
}

TEST(NistErrorModel, SuccessIsNeverAboveItsBoundAtThatSnirOrASmallerOne) {
    for (const Mode& each : bounded_modes()) {
        for (const int psdu_bytes : {14, 164, 1536}) {
            double min_bound = 2;
            for (int step = 23'036; step >= 0; --step) {  // from 1e4
                const double snir = 1e-6 * std::pow(1.001, step);
                min_bound = std::min(min_bound, nist().max_success(each, snir, psdu_bytes));
                EXPECT_LE(nist().success_probability(each, snir, psdu_bytes), min_bound)
                    << each.name << " at " << snir;
            }
        }
    }
}

// Where 1000 bytes fail once in a thousand times, the bound gives at least 99 successes in
// 100.
TEST(NistErrorModel, TheBoundIsCloseWhereNearlyAllSucceeds) {
    for (const Mode& each : bounded_modes()) {
        double snir = 0.1;
        while (nist().success_probability(each, snir, 1000) < 0.999) {
            snir *= 1.001;
        }
        EXPECT_GT(nist().min_success(each, snir, 1000), 0.99) << each.name;
    }
}

// Where one frame in a hundred succeeds, the bound gives less than one in five.
TEST(NistErrorModel, TheBoundFromAboveIsCloseWhereNearlyAllFails) {
    for (const Mode& each : bounded_modes()) {
        double snir = 1000;
        while (nist().success_probability(each, snir, 1000) > 0.01) {
            snir /= 1.001;
        }
        EXPECT_LT(nist().max_success(each, snir, 1000), 0.2) << each.name;
    }
}

TEST(NistErrorModel, OfCckThereIsNoBound) {
    for (const double mbps : {5.5, 11.0}) {
        EXPECT_EQ(nist().min_success(mode(mbps), infinity, 100), 0) << mbps;
        EXPECT_EQ(nist().max_success(mode(mbps), 0, 100), 1) << mbps;
    }
}

TEST(NistErrorModel, TheBoundSaysWhatIsCertain) {
    for (const Mode& each : bounded_modes()) {
        EXPECT_EQ(nist().min_success(each, 1000, 1000), 1) << each.name;
    }
}

// Above some SNIR the model stops computing: there the longest frame succeeds to the last digit.
// The SNIR values are 0.9 of the limits.
TEST(NistErrorModel, ShortCutForStrongSignalsChangesNoDigit) {
    for (const auto& [mbps, snir] :
         {std::pair{6.0, 13 * 0.9}, std::pair{9.0, 24 * 0.9}, std::pair{12.0, 26 * 0.9},
          std::pair{18.0, 48 * 0.9}, std::pair{24.0, 130 * 0.9}, std::pair{36.0, 240 * 0.9},
          std::pair{48.0, 840 * 0.9}, std::pair{54.0, 1008 * 0.9}}) {
        EXPECT_GT(nist().bit_error_rate(mode(mbps), snir), 0) << mbps;
        EXPECT_EQ(success(mbps, snir, 65535), 1) << mbps;
        EXPECT_EQ(nist().bit_error_rate(mode(mbps), snir / 0.9 * 1.001), 0) << mbps;
    }
}

TEST(NistErrorModel, LongerFramesFailMoreOften) {
    double last = 1;
    for (const int psdu_bytes : {14, 100, 500, 2304}) {
        const double now = success(24, 18, psdu_bytes);
        EXPECT_LT(now, last) << psdu_bytes;
        last = now;
    }
}

// Without data bits, a frame still has a header to lose.
TEST(NistErrorModel, HeaderAloneCanFailAFrame) {
    const double header = std::pow(1 - nist().bit_error_rate(mode(1), 1), 48);
    EXPECT_LT(header, 0.1);
    EXPECT_NEAR(success(11, 1, 0), header, 1e-12);
}

TEST(ErrorModel, EveryNameIsAModelOfItsOwn) {
    std::map<const ErrorModel*, std::string_view> names;
    for (const std::string_view name : error_model_names) {
        if (name != "Ieee80211BerTableErrorModel") {  // it needs a file
            const auto [other, is_new] = names.try_emplace(&test::error_model(name), name);
            EXPECT_TRUE(is_new) << name << " is the same as " << other->second;
        }
    }
}

TEST(ErrorModel, WithoutAModelNoFrameIsLostToNoise) {
    EXPECT_EQ(test::error_model("").success_probability(mode(54), 1e-6, 2304), 1);
    EXPECT_EQ(test::error_model("").min_success(mode(54), 1e-6, 2304), 1);
}

TEST(ErrorModel, UnknownNameIsAnError) {
    EXPECT_THROW(test::error_model("Ieee80211YansErrorModel"), ConfigError);
}

}  // namespace
}  // namespace netsim
