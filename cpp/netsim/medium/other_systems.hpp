// The power of other systems at each receiver: microwave ovens, foreign networks, radio links. It adds to the
// background noise, and never takes from it.
//
// Time is divided into intervals of one coherence time. In each interval, each radio gets the power
// P 10^(σ X / 10) with P the median in W, σ the standard deviation in dB, and X a standard normal number of
// its own. A log-normal power is the usual model of many foreign transmitters at unknown distances: L. F.
// Fenton, "The sum of log-normal probability distributions in scatter transmission systems", IRE Transactions
// on Communications Systems 8, 1960.
//
// Nothing is stored and nothing is scheduled: the power is a function of the run's seed, the radio and the
// index of the interval. It has no bandwidth: all receivers get all of it, as of the isotropic background
// noise. Receptions notice it, energy detection does not.
#pragma once

#include <cstdint>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/medium/interference.hpp"

namespace netsim {

class OtherSystems {
public:
    // `seed`: of the run.
    OtherSystems(const MediumConfig& config, std::uint64_t seed);

    bool is_none() const { return median_w_ == 0; }
    // In W, at the radio with that stream (InterfaceId::stream).
    double power_w(std::uint32_t radio, SimTime time) const;
    // The largest power from `start` until just before `end`, in W. `start` itself counts if they are equal.
    double max_w(std::uint32_t radio, SimTime start, SimTime end) const {
        return is_none() ? 0 : max_of_intervals_w(radio, start, end);
    }
    // Adds each interval's power to the sum, whose period is from `start` until just before `end`.
    void add_to(InterferenceSum& sum, std::uint32_t radio, SimTime start, SimTime end) const;

private:
    double power_of_interval_w(std::uint32_t radio, std::int64_t interval) const;
    double max_of_intervals_w(std::uint32_t radio, SimTime start, SimTime end) const;
    std::int64_t interval_at(SimTime time) const { return time.ps() / coherence_time_.ps(); }
    // The interval of the last instant before `end`, or that of `start`.
    std::int64_t last_interval(SimTime start, SimTime end) const;

    double median_w_;
    double standard_deviation_db_;
    SimTime coherence_time_;
    std::uint64_t seed_;
};

}  // namespace netsim
