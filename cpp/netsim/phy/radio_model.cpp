#include "netsim/phy/radio_model.hpp"

#include <cmath>

#include "netsim/phy/antenna.hpp"
#include "netsim/units.hpp"

namespace netsim {

namespace {

constexpr double half = 0.5;

// The least SNIR that is enough, to 0.001 dB; 100 dB if none is.
template <typename IsEnough>
double least_snir(IsEnough is_enough) {
    constexpr double farthest_db = 100;
    constexpr double precise_db = 1e-3;
    double too_low_db = -farthest_db;
    double enough_db = farthest_db;
    while (enough_db - too_low_db > precise_db) {
        const double middle_db = (too_low_db + enough_db) / 2;
        (is_enough(ratio_from_db(middle_db)) ? enough_db : too_low_db) = middle_db;
    }
    return ratio_from_db(enough_db);
}

}  // namespace

RadioModel::RadioModel(const RadioConfig& config, Medium& medium_, std::uint64_t seed_)
    : medium(medium_),
      seed(seed_),
      band{config.carrier_hz, config.bandwidth_hz},
      sensitivity_w(config.sensitivity_w),
      energy_detection_w(config.energy_detection_w),
      by_chunks(config.snir_mode == snir_by_chunks),
      frame_capture(config),
      preamble_detection(config),
      antenna(make_antenna(config.antenna, config.carrier_hz)),
      antenna_offset(config.antenna.offset),
      tx_power_by_bitrate_w_(config.tx_power_by_bitrate_w),
      error_model_(make_error_model(config)) {
    reception = {error_model_.get(), config.snir_threshold,
                 medium.background_noise().power_w(config.bandwidth_hz, config.noise_figure)};
    if (config.collision_model == collision_by_overlap) {
        reception.collision_w = config.sensitivity_w;
    }
}

double RadioModel::needed_snir(const Mode& mode, int psdu_bytes) const {
    const auto [known, is_new] = needed_snir_.try_emplace({&mode, psdu_bytes});
    if (is_new) {
        known->second = least_snir([&](double snir) {
            return snir > reception.snir_threshold &&
                   reception.errors->success_probability(mode, snir, psdu_bytes) >= half;
        });
    }
    return known->second;
}

double RadioModel::needed_header_snir(const Mode& mode) const {
    return least_snir([&](double snir) {
        return snir > reception.snir_threshold &&
               reception.errors->log_header_success(mode, snir) >= std::log(half);
    });
}

}  // namespace netsim
