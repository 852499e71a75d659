#include "netsim/propagation/propagation.hpp"

namespace netsim {

Propagation::Propagation(const MediumConfig& config, std::uint64_t seed)
    : path_loss_(make_path_loss(config)),
      two_ray_(config),
      fading_(config, seed),
      obstacles_(config),
      is_power_law_(two_ray_.is_none() && fading_.is_none() && obstacles_.empty()),
      max_factor_(fading_.max()) {}

double Propagation::other_gain(const Transmission& sent, InterfaceId receiver, const Position& place,
                               double distance_m, double least) const {
    const double of_path = path_gain(sent.origin, place, distance_m, sent.band.carrier_hz);
    // Every factor of the gain is here. The constructor multiplies their largest values; that of
    // obstacles is 1.
    const double gain = of_path * fading_.gain(sent.sender.stream(), receiver.stream(), sent.start, sent.id(),
                                               least / of_path);
    return obstacles_.empty() ? gain : gain * obstacles_.gain(sent.origin, place, sent.band.carrier_hz);
}

}  // namespace netsim
