// What is known of the energy at single receivers, for those for which bounds did not tell that the level is not reached. Kept for as
// long as anything that was foreseen lasts, then for another receiver: only few need one at any time.
//
// Kept by the watch over energy (energy_watch.hpp), which works out what goes into them.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "netsim/carrier_sense/energy_forecast.hpp"
#include "netsim/interface_id.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

struct EnergyOutlook {
    RadioId radio = 0;
    double missing_w = 0;       // more than that must come before there is somebody to tell of
    std::uint64_t next_id = 0;  // of the first transmission that it does not know
    // The radio was told of enough until then, when it is looked at; long ago if it has been.
    SimTime rests_until = SimTime::long_ago();
    EnergyForecast forecast;
};

class EnergyOutlooks {
public:
    // Radios are numbered in the order of being added.
    void add_radio() { index_of_.push_back(none); }
    bool has(RadioId radio) const { return index_of_[radio] != none; }
    // That of the radio; a new one, of its noise alone, if it has none. Others whose all has ended before `now` may be gone then.
    EnergyOutlook& of(RadioId radio, double noise_w, SimTime now) {
        if (!has(radio)) {
            begin(radio, noise_w, now);
        }
        return outlooks_[index_of_[radio]];
    }
    // How many there is memory for: as many as were needed at one time, and a few more.
    std::size_t capacity() const { return outlooks_.size(); }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    void begin(RadioId radio, double noise_w, SimTime now);
    void take_back(SimTime now);

    std::vector<std::uint32_t> index_of_;  // [radio], of `outlooks_`, or none
    std::deque<EnergyOutlook> outlooks_;
    std::vector<std::uint32_t> spare_;
};

}  // namespace netsim
