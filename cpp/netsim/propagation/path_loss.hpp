// Path loss: the share of a transmitted power that is left after a distance, a number from 0 to 1.
//
// These models are power laws, gain = coefficient / distance^exponent, capped at 1. The breakpoint
// model has one law on each side of a distance. So one plain class covers all, without a virtual
// call per receiver.
//   FreeSpacePathLoss: gain = λ² / (16 π² L d^α), with d the distance and λ = c / carrier the wavelength, in m, and L the
//     system loss.
//     H. T. Friis, "A Note on a Simple Transmission Formula", 1946, has α = 2.
//   BreakpointPathLoss: loss in dB = l01 + 10 α1 log10(d / 1 m) for d below the breakpoint, and
//     l02 + 10 α2 log10(d / breakpoint) at and above it; the same for all carriers. The defaults (8 m, 40.2
//     dB, 2, 58.5 dB, 3.3) are those of the coexistence study in IEEE 802.15.4-2006, annex E.
//   The fading models use free space.
//   The two-ray models are not power laws (two_ray.hpp). For them, this class is an upper bound.
// Used by Propagation for every pair of radios.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "netsim/config/medium_config.hpp"
#include "netsim/units.hpp"

namespace netsim {

class PathLoss {
public:
    struct PowerLaw {
        double coefficient = 1;  // gain at 1 m; with squared_wavelength, of a wavelength of 1 m
        double exponent = 2;
    };
    // Whether the gain is the same for all carriers, or rises with the square of the wavelength.
    enum class Carrier { any, squared_wavelength };

    PathLoss(PowerLaw law, Carrier carrier) : near_(law), far_(law), carrier_(carrier) {}
    // `near` below the breakpoint, `far` from there on.
    PathLoss(PowerLaw near, PowerLaw far, double breakpoint_m, Carrier carrier)
        : near_(near), far_(far), squared_breakpoint_m2_(breakpoint_m * breakpoint_m), carrier_(carrier) {}

    // Received over transmitted power at `distance_m` ≥ 0, between isotropic antennas. Distance 0
    // gives 1.
    double gain(double distance_m, double carrier_hz) const {
        return gain_at_squared_distance(distance_m * distance_m, carrier_hz);
    }

    // The same for a squared distance, in m², without a square root.
    double gain_at_squared_distance(double squared_distance_m2, double carrier_hz) const;

    // The distance in m within which the gain is at least `gain`, up to rounding: a search radius
    // needs a margin. 0 if `gain` is greater than 1, infinite if it is 0.
    double reach_m(double gain, double carrier_hz) const;

    // The largest gain at `distance_m` and beyond. The gain may rise once, at the breakpoint.
    double max_gain_beyond(double distance_m, double carrier_hz) const {
        const double here = gain(distance_m, carrier_hz);
        const double squared_m2 = distance_m * distance_m;
        return squared_m2 < squared_breakpoint_m2_ && squared_breakpoint_m2_ < infinite_m2
                   ? std::max(here, gain_at_squared_distance(squared_breakpoint_m2_, carrier_hz))
                   : here;
    }

    // No breakpoint: the gain falls steadily.
    bool is_one_law() const { return !(squared_breakpoint_m2_ < infinite_m2); }

private:
    static constexpr double infinite_m2 = std::numeric_limits<double>::infinity();

    double wavelength_factor(double carrier_hz) const {
        if (carrier_ == Carrier::any) {
            return 1;
        }
        const double wavelength_m = speed_of_light_mps / carrier_hz;
        return wavelength_m * wavelength_m;
    }

    PowerLaw near_;
    PowerLaw far_;
    double squared_breakpoint_m2_ = infinite_m2;
    Carrier carrier_;
};

inline double PathLoss::gain_at_squared_distance(double squared_distance_m2, double carrier_hz) const {
    const PowerLaw& law = squared_distance_m2 < squared_breakpoint_m2_ ? near_ : far_;
    const double at_one_metre = law.coefficient * wavelength_factor(carrier_hz);
    // Comparing before dividing also covers distance 0.
    const double divisor =
        law.exponent == 2 ? squared_distance_m2 : std::pow(squared_distance_m2, law.exponent / 2);
    return at_one_metre >= divisor ? 1 : at_one_metre / divisor;
}

// The model named by config.path_loss. Throws ConfigError for an unknown name.
PathLoss make_path_loss(const MediumConfig& config);

}  // namespace netsim
