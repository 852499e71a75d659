#include "netsim/phy/spread_error_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "netsim/error.hpp"
#include "netsim/phy/polynomial.hpp"

namespace netsim {
namespace {

double dbpsk(double bit_energy_over_noise) {
    return 0.5 * std::exp(-bit_energy_over_noise);
}

double dqpsk(double bit_energy_over_noise) {
    constexpr double sqrt2 = std::numbers::sqrt2;
    static const double factor = (sqrt2 + 1) / std::sqrt(8 * std::numbers::pi * sqrt2);
    return std::min(
        factor / std::sqrt(bit_energy_over_noise) * std::exp(-(2 - sqrt2) * bit_energy_over_noise), 1.0);
}

struct Neighbors {
    double squared_distance;
    double count;
};

template <std::size_t N>
double codeword_bit_error(double snir, const std::array<Neighbors, N>& spectrum, int bits) {
    double codeword_error = 0;
    for (const auto& [squared_distance, count] : spectrum) {
        codeword_error += count / 2 * std::erfc(std::sqrt(squared_distance * snir / 2));
    }
    return codeword_error < 1 ? -std::expm1(std::log1p(-codeword_error) / bits) : 1;
}

double cck_5_5(double snir) {
    return codeword_bit_error(snir, std::array<Neighbors, 2>{{{16, 14}, {32, 1}}}, 4);
}

double cck_11(double snir) {
    return codeword_bit_error(
        snir, std::array<Neighbors, 6>{{{8, 24}, {12, 16}, {16, 174}, {20, 16}, {24, 24}, {32, 1}}}, 8);
}

// Limits a fit to simulated CCK receivers to the range in which it is valid.
double within_fit(double snir, double (*fit)(double)) {
    if (snir > 10) {
        return 0;
    }
    return snir < 0.1 ? 0.5 : fit(snir);
}

double inet_cck_5_5(double snir) {
    return 0.53681634344 * std::exp(-std::pow((snir - 0.0033092430026) / 0.416543723610, 1.02889815344));
}

double inet_cck_11(double snir) {
    const double dividend = polynomial<3>(snir, {1.07406894673, -0.18397449399, 0.0079056742265});
    const double divisor = polynomial<4>(snir, {2.20327151287, 0.30552298746, 1.05233169046, 1});
    return dividend / divisor;
}

// Chips of a symbol, which are all received in its favor.
constexpr double barker_chips = 11;

using Rates = std::array<SpreadRate, 4>;

const SpreadRate& of_bitrate(const Rates& rates, std::int64_t bitrate_bps) {
    constexpr std::array<std::int64_t, 4> bitrates{1'000'000, 2'000'000, 5'500'000, 11'000'000};
    const auto* const found = std::ranges::find(bitrates, bitrate_bps);
    NETSIM_ASSERT(found != bitrates.end());
    return rates[static_cast<std::size_t>(found - bitrates.begin())];
}

}  // namespace

const SpreadRate& despreading_rates(std::int64_t bitrate_bps) {
    constexpr auto slow = [](double snir) { return dbpsk(2 * barker_chips * snir); };
    constexpr auto fast = [](double snir) { return dqpsk(barker_chips * snir); };
    static const std::array bounds{BitErrorBounds(slow), BitErrorBounds(fast), BitErrorBounds(cck_5_5),
                                   BitErrorBounds(cck_11)};
    static const Rates rates{
        {{slow, &bounds[0]}, {fast, &bounds[1]}, {cck_5_5, &bounds[2]}, {cck_11, &bounds[3]}}};
    return of_bitrate(rates, bitrate_bps);
}

const SpreadRate& inet_rates(std::int64_t bitrate_bps) {
    constexpr auto slow = [](double snir) { return dbpsk(2 * snir); };
    constexpr auto cck_slow = [](double snir) { return within_fit(snir, inet_cck_5_5); };
    constexpr auto cck_fast = [](double snir) { return within_fit(snir, inet_cck_11); };
    static const std::array bounds{BitErrorBounds(slow), BitErrorBounds(dqpsk)};
    static const Rates rates{
        {{slow, &bounds[0]}, {dqpsk, &bounds[1]}, {cck_slow, nullptr}, {cck_fast, nullptr}}};
    return of_bitrate(rates, bitrate_bps);
}

}  // namespace netsim
