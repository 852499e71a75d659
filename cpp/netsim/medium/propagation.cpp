#include "netsim/medium/propagation.hpp"

namespace netsim {

Propagation::Propagation(const MediumConfig& config, std::uint64_t seed)
    : path_loss_(make_path_loss(config)),
      two_ray_(config),
      fading_(config, seed),
      obstacles_(config),
      is_power_law_(two_ray_.is_none() && fading_.is_none() && obstacles_.empty()),
      most_factor_(fading_.most()) {}

double Propagation::other_gain(const Transmission& sent, InterfaceId receiver, const Position& place,
                               double distance_m, double least) const {
    const double path_gain = two_ray_.is_none()
                                 ? path_loss_.gain(distance_m, sent.band.carrier_hz)
                                 : two_ray_.gain(sent.origin, place, distance_m, sent.band.carrier_hz);
    // Every factor of the gain stands here, and its largest value in most_factor_; that of obstacles is 1.
    const double gain = path_gain * fading_.gain(sent.sender.stream(), receiver.stream(), sent.start, sent.id,
                                                 least / path_gain);
    return obstacles_.empty() ? gain : gain * obstacles_.gain(sent.origin, place, sent.band.carrier_hz);
}

}  // namespace netsim
