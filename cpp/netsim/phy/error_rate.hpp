// The probability that a frame survives noise and interference.
//
// The radio uses it at the end of a reception, with the minimum SNIR of the frame, or at the ends of
// its parts, with the SNIR of each time interval (phy/reception.hpp). Success ratios from a table:
// phy/ber_table.hpp.
//
// NIST model, s the linear SNIR: G. Pei and T. R. Henderson, "Validation of OFDM error rate model
// in ns-3", 2010.
//   OFDM: raw bit error p = ½erfc(√s) for BPSK, ½erfc(√(s/2)) for QPSK, ¾·½erfc(√(s/10)) for 16-QAM and
//     7/12·½erfc(√(s/42)) for 64-QAM. With D = √(4p(1-p)), coded bit error = the union bound over the weight
//     spectrum of the 802.11 convolutional code, at most 1. Header 24 bits at BPSK 1/2, data the bits of
//     Mode::data_bits.
//   DSSS and CCK (802.11b): phy/spread_error_rate.hpp.
//   Header of DSSS and CCK 48 bits at 1 Mbps, data 8 bits per byte.
// success = (1 - header bit error)^header bits · (1 - data bit error)^data bits.
//
// ns-3's model of the same name has the same bit error rates for OFDM.
#pragma once

#include <cmath>
#include <memory>

#include "netsim/config/radio_config.hpp"
#include "netsim/phy/modes.hpp"
#include "netsim/phy/spread_error_rate.hpp"

namespace netsim {

class ErrorModel {
public:
    virtual ~ErrorModel() = default;

    // In [0, 1]. `snir`: a linear ratio ≥ 0, may be infinite. `psdu_bytes` ≥ 0.
    virtual double success_probability(const Mode& mode, double snir, int psdu_bytes) const = 0;

    // A cheap lower bound for success_probability at that SNIR and above; ≤ 0 if there is none.
    // Exactly 1 only if all these probabilities are.
    virtual double min_success(const Mode& /*mode*/, double /*snir*/, int /*psdu_bytes*/) const { return 0; }

    // A cheap upper bound for success_probability at that SNIR and below; 1 if there is none.
    virtual double max_success(const Mode& /*mode*/, double /*snir*/, int /*psdu_bytes*/) const { return 1; }

    // Natural logarithms, ≤ 0, of the success probabilities of the PHY header and of the data. Their
    // sum is the logarithm for the whole frame. A fraction of a part has that fraction of its
    // logarithm. In a model without headers, the data has the whole logarithm.
    virtual double log_header_success(const Mode& /*mode*/, double /*snir*/) const { return 0; }
    virtual double log_data_success(const Mode& mode, double snir, int psdu_bytes) const {
        return std::log(success_probability(mode, snir, psdu_bytes));
    }
};

// The model of NIST for OFDM, with either kind of bit error rates for 802.11b.
class NistErrorModel final : public ErrorModel {
public:
    explicit NistErrorModel(SpreadRates spread_rates) : spread_rates_(spread_rates) {}

    double success_probability(const Mode& mode, double snir, int psdu_bytes) const override;
    double log_header_success(const Mode& mode, double snir) const override;
    double log_data_success(const Mode& mode, double snir, int psdu_bytes) const override;
    // Both have bounds for all modes except INET's of CCK.
    double min_success(const Mode& mode, double snir, int psdu_bytes) const override;
    double max_success(const Mode& mode, double snir, int psdu_bytes) const override;

    // Bit error rate of the data after decoding, in [0, 1].
    double bit_error_rate(const Mode& mode, double snir) const;

private:
    bool has_bounds(const Mode& mode) const;
    template <typename Rate>
    double lost_bits(const Mode& mode, int psdu_bytes, const Rate& rate) const;

    SpreadRates spread_rates_;
};

// A receiver without bit errors: only RadioConfig::snir_threshold decides.
class NoErrorModel final : public ErrorModel {
public:
    double success_probability(const Mode& /*mode*/, double /*snir*/, int /*psdu_bytes*/) const override {
        return 1;
    }
    double min_success(const Mode& /*mode*/, double /*snir*/, int /*psdu_bytes*/) const override { return 1; }
};

// The model of RadioConfig::error_model. Reads its file if it has one; models without parameters are static. Throws
// ConfigError for an unknown name or an invalid file.
std::shared_ptr<const ErrorModel> make_error_model(const RadioConfig& config);

}  // namespace netsim
