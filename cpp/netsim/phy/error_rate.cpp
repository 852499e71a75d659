#include "netsim/phy/error_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "netsim/config/check.hpp"
#include "netsim/config/radio_config.hpp"
#include "netsim/error.hpp"
#include "netsim/phy/ber_table.hpp"
#include "netsim/phy/bit_error_bounds.hpp"
#include "netsim/phy/oqpsk_error_rate.hpp"
#include "netsim/phy/polynomial.hpp"
#include "netsim/phy/spread_error_rate.hpp"

namespace netsim {
namespace {

double to_the_fifth(double x) {
    return x * x * x * x * x;
}

// Bit error rate of OFDM after decoding. The raw bit error rate is p = share · ½ erfc(√x), where x
// is the SNIR divided by a constant of the constellation.
double coded_bit_error(Constellation constellation, CodeRate code_rate, double snir) {
    double share = 1;
    double x = snir;
    switch (constellation) {
        case Constellation::bpsk:
            break;
        case Constellation::qpsk:
            x = snir / 2;
            break;
        case Constellation::qam16:
            share = 3.0 / 4;
            x = snir / 10;
            break;
        case Constellation::qam64:
            share = 7.0 / 12;
            x = snir / 42;
            break;
    }
    // Above these x, the union bound is below 1e-24. Even over a million bits, the success
    // probability rounds to 1.
    constexpr double last_x_one_half = 13;
    constexpr double last_x_two_thirds = 20;
    constexpr double last_x_three_quarters = 24;
    const double last_x = code_rate == CodeRate::one_half     ? last_x_one_half
                          : code_rate == CodeRate::two_thirds ? last_x_two_thirds
                                                              : last_x_three_quarters;
    if (x > last_x) {
        return 0;
    }

    const double p = share * 0.5 * std::erfc(std::sqrt(x));
    const double d_squared = 4 * p * (1 - p);
    double bound = 0;
    switch (code_rate) {
        case CodeRate::one_half:  // even powers only, from D^10 on
            bound =
                1.0 / 2 * to_the_fifth(d_squared) *
                polynomial<9>(d_squared, {36, 211, 1404, 11633, 77433, 502690, 3322763, 21292910, 134365911});
            break;
        case CodeRate::two_thirds:  // from D^6 on
            bound = 1.0 / 4 * d_squared * d_squared * d_squared *
                    polynomial<10>(std::sqrt(d_squared),
                                   {3, 70, 285, 1276, 6160, 27128, 117019, 498860, 2103891, 8784123});
            break;
        case CodeRate::three_quarters: {  // from D^5 on
            const double d = std::sqrt(d_squared);
            bound = 1.0 / 6 * to_the_fifth(d) *
                    polynomial<10>(
                        d, {42, 201, 1492, 10469, 62935, 379644, 2253373, 13073811, 75152755, 428005675});
            break;
        }
        case CodeRate::none:
            NETSIM_ASSERT(code_rate != CodeRate::none);
    }
    return std::min(bound, 1.0);
}

// The bitrate of the header of 802.11b.
constexpr std::int64_t slowest_bps = 1'000'000;

// Margin for the rounding of the bounds and of the values that they bound.
constexpr double bounds_rounding = 1e-9;

const BitErrorBounds& ofdm_bounds(Constellation constellation, CodeRate code_rate) {
    static const auto bounds = [] {
        std::array<std::array<std::unique_ptr<const BitErrorBounds>, 4>, 4>
            all;  // [constellation][code rate]
        using enum Constellation;
        using enum CodeRate;
        for (const Constellation each : {bpsk, qpsk, qam16, qam64}) {
            for (const CodeRate rate : {one_half, two_thirds, three_quarters}) {
                all[static_cast<std::size_t>(each)][static_cast<std::size_t>(rate)] =
                    std::make_unique<const BitErrorBounds>(
                        [each, rate](double snir) { return coded_bit_error(each, rate, snir); });
            }
        }
        return all;
    }();
    return *bounds[static_cast<std::size_t>(constellation)][static_cast<std::size_t>(code_rate)];
}

double log_success(double bit_error, double bits) {
    if (bit_error == 0 || bits == 0) {
        return 0;
    }
    return bit_error < 1 ? bits * std::log1p(-bit_error) : -std::numeric_limits<double>::infinity();
}

}  // namespace

// Expected bit errors of a frame, header included, for the bit error rates that `rate(const
// BitErrorBounds&)` returns. Needs bounds.
template <typename Rate>
double NistErrorModel::lost_bits(const Mode& mode, int psdu_bytes, const Rate& rate) const {
    const auto bits = static_cast<double>(mode.data_bits(psdu_bytes));
    if (mode.family == ModeFamily::ofdm) {
        static const BitErrorBounds& header = ofdm_bounds(Constellation::bpsk, CodeRate::one_half);
        return mode.header_bits * rate(header) + bits * rate(ofdm_bounds(mode.constellation, mode.code_rate));
    }
    const SpreadRate& header = spread_rates_(slowest_bps);
    return mode.header_bits * rate(*header.bounds) + bits * rate(*spread_rates_(mode.bitrate_bps).bounds);
}

bool NistErrorModel::has_bounds(const Mode& mode) const {
    return mode.family == ModeFamily::ofdm || spread_rates_(mode.bitrate_bps).bounds != nullptr;
}

double NistErrorModel::bit_error_rate(const Mode& mode, double snir) const {
    NETSIM_ASSERT(snir >= 0 && mode.family != ModeFamily::oqpsk);  // an 802.11 mode
    return mode.family == ModeFamily::ofdm ? coded_bit_error(mode.constellation, mode.code_rate, snir)
                                           : spread_rates_(mode.bitrate_bps).bit_error(snir);
}

double NistErrorModel::success_probability(const Mode& mode, double snir, int psdu_bytes) const {
    const double log_of_both = log_header_success(mode, snir) + log_data_success(mode, snir, psdu_bytes);
    return log_of_both == 0 ? 1 : std::exp(log_of_both);
}

double NistErrorModel::log_header_success(const Mode& mode, double snir) const {
    NETSIM_ASSERT(snir >= 0);
    return log_success(mode.family == ModeFamily::ofdm
                           ? coded_bit_error(Constellation::bpsk, CodeRate::one_half, snir)
                           : spread_rates_(slowest_bps).bit_error(snir),
                       mode.header_bits);
}

// If n bits fail independently, each with probability b at most, all survive with a probability of
// at least 1 − n b.
double NistErrorModel::min_success(const Mode& mode, double snir, int psdu_bytes) const {
    if (!has_bounds(mode)) {
        return 0;
    }
    const double lost =
        lost_bits(mode, psdu_bytes, [snir](const BitErrorBounds& rate) { return rate.ceiling(snir); });
    constexpr double nothing = 0x1p-60;  // 1 minus less than this rounds to 1
    return lost < nothing ? 1 : 1 - bounds_rounding - lost;
}

// If each bit fails with probability b at least, the probability that all survive is at most
// (1 − b)^n ≤ e^(−n b) ≤ 1 / (1 + n b + (n b)² / 2).
double NistErrorModel::max_success(const Mode& mode, double snir, int psdu_bytes) const {
    if (!has_bounds(mode)) {
        return 1;
    }
    const double lost =
        lost_bits(mode, psdu_bytes, [snir](const BitErrorBounds& rate) { return rate.floor(snir); });
    return (1 + bounds_rounding) / (1 + lost + lost * lost / 2);
}

double NistErrorModel::log_data_success(const Mode& mode, double snir, int psdu_bytes) const {
    return log_success(bit_error_rate(mode, snir), static_cast<double>(mode.data_bits(psdu_bytes)));
}

namespace {

using Made = std::shared_ptr<const ErrorModel>;

// A model without parameters is static, and is not owned.
Made shared(const ErrorModel& model) {
    return {Made(), &model};
}

constexpr Factory<Made (*)(const RadioConfig&)> factories[] = {
    {"Ieee80211DespreadingErrorModel",
     [](const RadioConfig&) {
         static const NistErrorModel model(despreading_rates);
         return shared(model);
     }},
    {"Ieee80211NistErrorModel",
     [](const RadioConfig&) {
         static const NistErrorModel model(inet_rates);
         return shared(model);
     }},
    {"Ieee80211BerTableErrorModel",
     [](const RadioConfig& config) -> Made {
         return std::make_shared<const BerTableErrorModel>(config.ber_table_file);
     }},
    {"Ieee802154ErrorModel",
     [](const RadioConfig&) {
         static const OqpskErrorModel model;
         return shared(model);
     }},
    {"",
     [](const RadioConfig&) {
         static const NoErrorModel model;
         return shared(model);
     }},
};
static_assert(makes_all(factories, error_models));

}  // namespace

std::shared_ptr<const ErrorModel> make_error_model(const RadioConfig& config) {
    check_name("radio.error_model", config.error_model, error_model_names);
    return factory_of(config.error_model, factories)(config);
}

}  // namespace netsim
