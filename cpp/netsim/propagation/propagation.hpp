// Propagation of a transmission from one end of a link to the other: gain and delay.
//
// The gain is the product of path loss (with or without a ground), shadowing, fading and obstacles.
// Antennas are separate (antennas.hpp). The medium computes gains for pairs of radios. To find the
// radios in reach of a sender, it uses upper bounds that no gain exceeds.
#pragma once

#include <cstdint>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/propagation/fading.hpp"
#include "netsim/propagation/obstacles.hpp"
#include "netsim/propagation/path_loss.hpp"
#include "netsim/propagation/transmission.hpp"
#include "netsim/propagation/two_ray.hpp"
#include "netsim/trace/power_budget.hpp"
#include "netsim/units.hpp"

namespace netsim {

class Propagation {
public:
    // `seed`: of the run. Throws ConfigError for an unknown path loss.
    Propagation(const MediumConfig& config, std::uint64_t seed);

    // Received over transmitted power for the interface `receiver`, which is at `place` when the
    // transmission starts, `distance_m` from its origin. Depends on the arguments only, and is
    // reciprocal for equal start and id. May return 0 for a gain below `least`, which is cheaper.
    double gain(const Transmission& sent, InterfaceId receiver, const Position& place, double distance_m,
                double least = 0) const {
        if (is_power_law_) {
            return path_loss_.gain(distance_m, sent.band.carrier_hz);
        }
        return other_gain(sent, receiver, place, distance_m, least);
    }

    // Fills in the factors of that gain, all but those of the antennas. Their product may differ from
    // it by rounding.
    void explain(const Transmission& sent, InterfaceId receiver, const Position& place, double distance_m,
                 PowerBudget& budget) const;

    // The distance in m beyond which no gain reaches `gain`, up to rounding: a search radius needs
    // a margin. 0 if no gain reaches it at all, infinite if `gain` is 0.
    double reach_m(double gain, double carrier_hz) const {
        return path_loss_.reach_m(gain / max_factor_, carrier_hz);
    }

    // The distance in m up to which every gain is at least `gain`, up to rounding. 0 if unknown.
    double sure_reach_m(double gain, double carrier_hz) const {
        return is_power_law_ && path_loss_.is_one_law() ? path_loss_.reach_m(gain, carrier_hz) : 0;
    }

    // The distance in m beyond which that gain is not reached without shadowing and fading, up to
    // rounding.
    double steady_reach_m(double gain, double carrier_hz) const {
        return path_loss_.reach_m(gain, carrier_hz);
    }

    // An upper bound for gains at `distance_m` and beyond, up to rounding.
    double max_gain_beyond(double distance_m, double carrier_hz) const {
        return max_factor_ * path_loss_.max_gain_beyond(distance_m, carrier_hz);
    }

    // The path loss alone, between two places, without shadowing, fading and obstacles.
    double path_gain(const Position& from, const Position& to, double distance_m, double carrier_hz) const {
        return two_ray_.is_none() ? path_loss_.gain(distance_m, carrier_hz)
                                  : two_ray_.gain(from, to, distance_m, carrier_hz);
    }
    const Fading& shadowing() const { return shadowing_; }
    const Fading& fading() const { return fading_; }
    // Whether distance alone decides the gain.
    bool is_power_law() const { return is_power_law_; }
    // Whether gains are drawn from a distribution.
    bool is_random() const { return !(shadowing_.is_none() && fading_.is_none()); }

private:
    // The path loss of the direct ray.
    double direct_gain(double distance_m, double carrier_hz) const {
        return two_ray_.is_none() ? path_loss_.gain(distance_m, carrier_hz)
                                  : two_ray_.direct_gain(distance_m, carrier_hz);
    }
    double other_gain(const Transmission& sent, InterfaceId receiver, const Position& place,
                      double distance_m, double least) const;

    PathLoss path_loss_;  // for the two-ray models: an upper bound
    TwoRay two_ray_;
    Fading shadowing_;
    Fading fading_;
    Obstacles obstacles_;
    bool is_power_law_;  // no other factor; true for most networks
    double max_factor_;  // the largest possible gain over that of the path loss
};

// At the speed of light.
inline SimTime propagation_delay(double distance_m) {
    return SimTime::from_seconds(distance_m / speed_of_light_mps);
}

// At least that delay, for any number, with an upper limit of 46 days.
inline SimTime max_propagation_delay(double distance_m) {
    constexpr double long_s = 4e6;
    const double delay_s = distance_m / speed_of_light_mps;
    return delay_s < long_s ? SimTime::from_seconds(delay_s) + SimTime::from_ns(1)
                            : SimTime::from_seconds(long_s);
}

}  // namespace netsim
