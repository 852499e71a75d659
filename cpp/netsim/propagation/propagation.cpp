#include "netsim/propagation/propagation.hpp"

namespace netsim {

Propagation::Propagation(const MediumConfig& config, std::uint64_t seed)
    : path_loss_(make_path_loss(config)),
      two_ray_(config),
      shadowing_(Fading::shadowing(config, seed)),
      fading_(config, seed),
      obstacles_(config),
      is_power_law_(two_ray_.is_none() && !is_random() && obstacles_.empty()),
      max_factor_(shadowing_.max() * fading_.max()) {}

double Propagation::other_gain(const Transmission& sent, InterfaceId receiver, const Position& place,
                               double distance_m, double least) const {
    const double of_path = path_gain(sent.origin, place, distance_m, sent.band.carrier_hz);
    // Every factor of the gain is here. The constructor multiplies their largest values; that of
    // obstacles is 1.
    const auto factor = [&](const Fading& fading, double least_factor) {
        return fading.gain(sent.sender.stream(), receiver.stream(), sent.start, sent.id(), least_factor);
    };
    const double shadowed = of_path * factor(shadowing_, least / (of_path * fading_.max()));
    if (shadowed == 0) {
        return 0;
    }
    const double gain = shadowed * factor(fading_, least / shadowed);
    return obstacles_.empty() ? gain : gain * obstacles_.gain(sent.origin, place, sent.band.carrier_hz);
}

void Propagation::explain(const Transmission& sent, InterfaceId receiver, const Position& place,
                          double distance_m, PowerBudget& budget) const {
    const double carrier_hz = sent.band.carrier_hz;
    const auto factor = [&](const Fading& fading) {
        return fading.gain(sent.sender.stream(), receiver.stream(), sent.start, sent.id());
    };
    budget.distance = direct_gain(distance_m, carrier_hz);
    budget.ground = path_gain(sent.origin, place, distance_m, carrier_hz) / budget.distance;
    budget.shadowing = factor(shadowing_);
    budget.fading = factor(fading_);
    budget.obstacles = obstacles_.crossed(sent.origin, place, carrier_hz);
}

}  // namespace netsim
