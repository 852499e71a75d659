// What is left of a transmission on its way from one end of a link to the other: power and time.
//
// The gain is the product of what happens on the way: path loss, with or without a ground, fading, and obstacles; the
// antennas at its ends are not of it (antennas.hpp). The medium
// asks for it for every pair of radios, and it has to search the places around a sender for those whom it reaches: for
// that there are bounds, which no gain ever exceeds.
#pragma once

#include <cstdint>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/propagation/fading.hpp"
#include "netsim/propagation/obstacles.hpp"
#include "netsim/propagation/path_loss.hpp"
#include "netsim/propagation/transmission.hpp"
#include "netsim/propagation/two_ray.hpp"
#include "netsim/units.hpp"

namespace netsim {

class Propagation {
public:
    // `seed` is that of the run. Throws ConfigError for a path loss of an unknown name.
    Propagation(const MediumConfig& config, std::uint64_t seed);

    // Received over transmitted power for the interface `receiver`, at `place` when the transmission starts, `distance_m` from
    // its origin. A function of its arguments: no order, no memory. Reciprocal, if start and id are the same. Where it is less
    // than `least`, perhaps 0 instead: that may cost a fraction.
    double gain(const Transmission& sent, InterfaceId receiver, const Position& place, double distance_m,
                double least = 0) const {
        if (is_power_law_) {
            return path_loss_.gain(distance_m, sent.band.carrier_hz);
        }
        return other_gain(sent, receiver, place, distance_m, least);
    }

    // The distance in m beyond which no gain reaches `gain`, up to rounding: a search radius needs a margin. 0 if not
    // even the gain at distance 0 does, infinite if `gain` is 0.
    double reach_m(double gain, double carrier_hz) const {
        return path_loss_.reach_m(gain / most_factor_, carrier_hz);
    }

    // Up to that distance in m every gain is at least `gain`, up to rounding. 0 if no such distance is known.
    double sure_reach_m(double gain, double carrier_hz) const {
        return is_power_law_ && path_loss_.is_one_law() ? path_loss_.reach_m(gain, carrier_hz) : 0;
    }

    // No gain is larger at `distance_m` and beyond, up to rounding.
    double most_gain_beyond(double distance_m, double carrier_hz) const {
        return most_factor_ * path_loss_.most_gain_beyond(distance_m, carrier_hz);
    }

    // Of that, the path loss alone, between two places: without fading and obstacles.
    double path_gain(const Position& from, const Position& to, double distance_m, double carrier_hz) const {
        return two_ray_.is_none() ? path_loss_.gain(distance_m, carrier_hz)
                                  : two_ray_.gain(from, to, distance_m, carrier_hz);
    }
    const Fading& fading() const { return fading_; }
    // Whether gains are drawn from a distribution.
    bool is_random() const { return !fading_.is_none(); }

private:
    double other_gain(const Transmission& sent, InterfaceId receiver, const Position& place,
                      double distance_m, double least) const;

    PathLoss path_loss_;  // of the two-ray models: their bound
    TwoRay two_ray_;
    Fading fading_;
    Obstacles obstacles_;
    bool is_power_law_;   // and nothing else: most networks
    double most_factor_;  // the largest possible gain over that of the path loss
};

// The time that light takes.
inline SimTime propagation_delay(double distance_m) {
    return SimTime::from_seconds(distance_m / speed_of_light_mps);
}

// At least that, for any number; years are as good as for ever.
inline SimTime most_propagation_delay(double distance_m) {
    constexpr double long_s = 4e6;
    const double delay_s = distance_m / speed_of_light_mps;
    return delay_s < long_s ? SimTime::from_seconds(delay_s) + SimTime::from_ns(1)
                            : SimTime::from_seconds(long_s);
}

}  // namespace netsim
