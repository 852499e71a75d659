#include "netsim/phy/radio_model.hpp"

#include "netsim/phy/antenna.hpp"

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

}  // namespace netsim
