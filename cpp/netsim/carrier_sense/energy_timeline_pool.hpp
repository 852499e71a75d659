// The energy timelines of those receivers where bounds do not exclude a busy channel. A timeline is
// kept while any of its arrivals lasts, and then reused for another receiver: few receivers need
// one at any time.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "netsim/carrier_sense/energy_timeline.hpp"
#include "netsim/interface_id.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

struct ReceiverTimeline {
    RadioId radio = 0;
    double headroom_w = 0;      // the sum may rise by this before another arrival must be reported
    std::uint64_t next_id = 0;  // id of the first transmission that the timeline does not contain
    // When the radio is evaluated again, because the reported arrivals suffice until then. Long ago
    // if no evaluation is deferred.
    SimTime deferred_until = SimTime::long_ago();
    EnergyTimeline timeline;
};

class EnergyTimelinePool {
public:
    // Radios are numbered in the order of being added.
    void add_radio() { index_of_.push_back(none); }
    bool has(RadioId radio) const { return index_of_[radio] != none; }
    // The radio's timeline. If it has none, a new one with noise alone; that may reclaim timelines
    // that ended before `now`.
    ReceiverTimeline& of(RadioId radio, double noise_w, SimTime now) {
        if (!has(radio)) {
            begin(radio, noise_w, now);
        }
        return timelines_[index_of_[radio]];
    }
    // Timelines in memory: the largest number needed at one time, and a few more.
    std::size_t capacity() const { return timelines_.size(); }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    void begin(RadioId radio, double noise_w, SimTime now);
    void reclaim(SimTime now);

    std::vector<std::uint32_t> index_of_;  // [radio], into `timelines_`, or none
    std::deque<ReceiverTimeline> timelines_;
    std::vector<std::uint32_t> spare_;
};

}  // namespace netsim
