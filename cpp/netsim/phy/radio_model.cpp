#include "netsim/phy/radio_model.hpp"

#include "netsim/phy/antenna.hpp"
#include "netsim/units.hpp"

namespace netsim {

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
      error_model_(make_error_model(config)) {
    reception = {error_model_.get(), config.snir_threshold,
                 medium.background_noise().power_w(config.bandwidth_hz, config.noise_figure)};
    if (config.collision_model == collision_by_overlap) {
        reception.collision_w = config.sensitivity_w;
    }
}

double RadioModel::needed_snir(const Mode& mode, int psdu_bytes) const {
    constexpr double half = 0.5;
    constexpr double farthest_db = 100;
    constexpr double precise_db = 1e-3;
    const auto [known, is_new] = needed_snir_.try_emplace({&mode, psdu_bytes});
    if (is_new) {
        double too_low_db = -farthest_db;
        double enough_db = farthest_db;
        while (enough_db - too_low_db > precise_db) {
            const double middle_db = (too_low_db + enough_db) / 2;
            const double snir = ratio_from_db(middle_db);
            const bool is_enough = snir > reception.snir_threshold &&
                                   reception.errors->success_probability(mode, snir, psdu_bytes) >= half;
            (is_enough ? enough_db : too_low_db) = middle_db;
        }
        known->second = ratio_from_db(enough_db);
    }
    return known->second;
}

}  // namespace netsim
