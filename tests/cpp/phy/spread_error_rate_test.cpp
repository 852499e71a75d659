// The distances of codewords come from IEEE Std 802.11-2020, 16.4.6.6, here by listing all of them.
#include "netsim/phy/spread_error_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/phy/error_rate.hpp"
#include "netsim/phy/modes.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

constexpr std::array<std::int64_t, 4> bitrates{1'000'000, 2'000'000, 5'500'000, 11'000'000};

using Codeword = std::array<std::complex<double>, 8>;

// The four phases in quarters of a circle.
Codeword codeword(int phase_1, int phase_2, int phase_3, int phase_4) {
    const auto chip = [](int quarters) { return std::polar(1.0, quarters * std::numbers::pi / 2); };
    return {chip(phase_1 + phase_2 + phase_3 + phase_4),
            chip(phase_1 + phase_3 + phase_4),
            chip(phase_1 + phase_2 + phase_4),
            -chip(phase_1 + phase_4),
            chip(phase_1 + phase_2 + phase_3),
            chip(phase_1 + phase_3),
            -chip(phase_1 + phase_2),
            chip(phase_1)};
}

std::vector<Codeword> codewords_of_5_5_mbps() {
    std::vector<Codeword> all;
    for (int symbol = 0; symbol < 4; ++symbol) {
        for (const int phase_2 : {1, 3}) {
            for (const int phase_4 : {0, 2}) {
                all.push_back(codeword(symbol, phase_2, 0, phase_4));
            }
        }
    }
    return all;
}

std::vector<Codeword> codewords_of_11_mbps() {
    std::vector<Codeword> all;
    for (int number = 0; number < 256; ++number) {
        all.push_back(codeword(number % 4, number / 4 % 4, number / 16 % 4, number / 64));
    }
    return all;
}

// Union bound of the probability that another codeword is nearer than the one that was sent.
double codeword_error(const std::vector<Codeword>& codewords, std::size_t sent, double snir) {
    double error = 0;
    for (const Codeword& other : codewords) {
        double squared_distance = 0;
        for (std::size_t chip = 0; chip < other.size(); ++chip) {
            squared_distance += std::norm(other[chip] - codewords[sent][chip]);
        }
        error += squared_distance > 0.1 ? std::erfc(std::sqrt(squared_distance * snir / 2)) / 2 : 0;
    }
    return error;
}

void expect_codeword_error(std::int64_t bitrate_bps, const std::vector<Codeword>& codewords, int bits) {
    for (const double snir : {0.8, 1.5, 2.0, 2.5, 3.5}) {
        const double bit_error = despreading_rates(bitrate_bps).bit_error(snir);
        for (const std::size_t sent : {std::size_t{0}, codewords.size() - 1}) {
            EXPECT_NEAR(-std::expm1(bits * std::log1p(-bit_error)) / codeword_error(codewords, sent, snir), 1,
                        1e-6)
                << bitrate_bps << " bps, SNIR " << snir;
        }
    }
}

TEST(DespreadingRates, CckErrorsAreTheUnionBoundOverTheCodewords) {
    expect_codeword_error(5'500'000, codewords_of_5_5_mbps(), 4);
    expect_codeword_error(11'000'000, codewords_of_11_mbps(), 8);
}

// 11 chips for each symbol instead of one.
TEST(DespreadingRates, DsssGainsElevenfoldOverInets) {
    for (const std::int64_t bitrate_bps : {1'000'000, 2'000'000}) {
        for (const double snir : {0.01, 0.3, 1.0, 2.0}) {
            EXPECT_EQ(despreading_rates(bitrate_bps).bit_error(snir),
                      inet_rates(bitrate_bps).bit_error(11 * snir));
        }
    }
}

TEST(DespreadingRates, AreAtMostOneAndFallWithTheSnir) {
    for (const std::int64_t bitrate_bps : bitrates) {
        double last = 1;
        for (int step = 0; step < 1400; ++step) {
            const double bit_error =
                despreading_rates(bitrate_bps).bit_error(ratio_from_db(-30 + 0.05 * step));
            EXPECT_LE(bit_error, last) << bitrate_bps << " bps, step " << step;
            EXPECT_GE(bit_error, 0) << bitrate_bps << " bps, step " << step;
            last = bit_error;
        }
    }
}

// The SNIR in dB at which half of the frames of 1000 B arrive.
double half_db(double mbps) {
    const NistErrorModel model(despreading_rates);
    double snir_db = -20;
    while (model.success_probability(mode_set("g(mixed)").mode_for_bitrate(mbps * 1e6),
                                     ratio_from_db(snir_db), 1000) < 0.5) {
        snir_db += 0.01;
    }
    return snir_db;
}

TEST(DespreadingRates, NoSlowerRateNeedsMoreThanAFasterOneOfItsModulation) {
    EXPECT_LT(half_db(1), half_db(2));
    EXPECT_LT(half_db(2), half_db(11));
    EXPECT_LT(half_db(5.5), half_db(11));
}

TEST(DespreadingRates, SuccessIsWithinItsBounds) {
    const NistErrorModel model(despreading_rates);
    for (const std::int64_t bitrate_bps : bitrates) {
        const Mode& mode = mode_set("g(mixed)").mode_for_bitrate(static_cast<double>(bitrate_bps));
        for (int step = 0; step < 23'037; ++step) {  // up to 1e4
            const double snir = 1e-6 * std::pow(1.001, step);
            const double success = model.success_probability(mode, snir, 1000);
            EXPECT_LE(model.min_success(mode, snir, 1000), success) << bitrate_bps << " bps, SNIR " << snir;
            EXPECT_GE(model.max_success(mode, snir, 1000), success) << bitrate_bps << " bps, SNIR " << snir;
        }
        EXPECT_EQ(model.min_success(mode, 1000, 1000), 1) << bitrate_bps;
    }
}

}  // namespace
}  // namespace netsim
