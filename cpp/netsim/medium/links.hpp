// The radios of one network and the links between them: positions, receiver parameters, and the
// power of a transmission at each radio, exact and as an upper bound.
//
// Links does not know what is on the air (active_transmissions.hpp). The medium calls it for pairs
// of a transmission and a radio.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/prefetch.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/displacement_bound.hpp"
#include "netsim/medium/receiver.hpp"
#include "netsim/medium/receiver_group.hpp"
#include "netsim/propagation/antennas.hpp"
#include "netsim/propagation/propagation.hpp"
#include "netsim/propagation/transmission.hpp"
#include "netsim/trace/frame_observer.hpp"
#include "netsim/trace/power_budget.hpp"

namespace netsim {

class Links {
public:
    // `seed`: of the run, for fading.
    Links(const MediumConfig& config, std::uint64_t seed) : propagation_(config, seed) {}

    // Returns the radio's id (Medium::attach).
    RadioId add(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna, SimTime now);
    // The objects that an arrival at the radio reads in the layers above, to be prefetched
    // (kernel/prefetch.hpp). May be null.
    void set_prefetch_targets(RadioId radio, const void* interface, const void* protocol) {
        radios_[radio].interface_target = interface;
        radios_[radio].protocol_target = protocol;
    }

    RadioId count() const { return static_cast<RadioId>(radios_.size()); }
    MediumListener& listener(RadioId radio) const { return *radios_[radio].listener; }
    InterfaceId interface(RadioId radio) const { return InterfaceId::of_stream(radios_[radio].stream); }
    const ReceiverParameters& receiver(RadioId radio) const { return parameters_[radios_[radio].parameters]; }
    Position position(RadioId radio, SimTime time) const { return trajectories_[radio]->position_at(time); }
    // Index into groups().
    std::uint32_t group_of(RadioId radio) const { return group_of_[radios_[radio].parameters]; }
    std::deque<ReceiverGroup>& groups() { return groups_; }
    const std::deque<ReceiverGroup>& groups() const { return groups_; }
    DisplacementBound& displacement() { return displacement_; }
    const DisplacementBound& displacement() const { return displacement_; }
    // The radio at the frame's destination that can decode it. -1 for a broadcast, or if there is no
    // such radio.
    RadioId addressee_of(const Transmission& sent) const;
    // The radio of that node that can decode the frame; -1 if there is none.
    RadioId decoder_at(NodeId node, const Transmission& sent) const;

    // Whether the radio takes part in cumulative energy detection (Medium::watch_energy).
    bool watches_energy(RadioId radio) const { return radios_[radio].watches_energy != 0; }
    void set_watches_energy(RadioId radio, bool watches) { radios_[radio].watches_energy = watches ? 1 : 0; }
    // Prefetches what a transmission reads of a radio near it (kernel/prefetch.hpp).
    void prefetch(RadioId radio) const { netsim::prefetch(radios_[radio]); }
    // Prefetches what a transmission reads of its sender.
    void prefetch_sender(RadioId radio) const {
        prefetch(radio);
        netsim::prefetch(trajectories_[radio]);
    }
    // Prefetches what an arrival reads in the layers above. Call it after prefetch(radio).
    void prefetch_targets(RadioId radio) const {
        const Radio& there = radios_[radio];
        prefetch_bytes(there.listener, cache_line_bytes);
        prefetch_bytes(there.interface_target, cache_line_bytes);
        prefetch_bytes(there.protocol_target, cache_line_bytes);
    }

    // The power in W at `radio`, which is at `place` when the transmission starts. `share`: fraction
    // of the transmission's power in the radio's band. To save time, may return 0 for a power below
    // `min_w`. Inline: the hottest function of the medium.
    [[gnu::always_inline]] double power_w(const Transmission& sent, double share, RadioId radio,
                                          const Position& place, double distance_m, double min_w = 0) const {
        const InterfaceId receiver = interface(radio);
        const double in_band_w = sent.power_w * share;
        if (antennas_.all_isotropic()) {
            return in_band_w * propagation_.gain(sent, receiver, place, distance_m, min_w / in_band_w);
        }
        const double antenna_gain = antennas_.gain(sent, radio, place);
        return in_band_w *
               propagation_.gain(sent, receiver, place, distance_m, min_w / (in_band_w * antenna_gain)) *
               antenna_gain;
    }
    // Inline: sums over all active transmissions call it once for each.
    Arrival arrival(const Transmission& sent, double share, RadioId radio, const Position& place) const {
        const double distance_m = distance(sent.origin, place);
        const SimTime start = sent.start + propagation_delay(distance_m);
        const double received_w = power_w(sent, share, radio, place, distance_m);
        return Arrival{&sent,      start, start + sent.duration,
                       received_w, place, receiver(radio).can_lock_on(sent, received_w)};
    }

    // The factors of that power.
    PowerBudget power_budget(const Transmission& sent, RadioId radio, const Position& place) const;
    // What an observer gets of a transmission that is below the radio's sensitivity; nothing if it
    // reaches that. The radio must be able to decode it.
    std::optional<FrameObserver::Loss> below_sensitivity(const Transmission& sent, RadioId radio,
                                                         const Position& place) const;
    // Whether the power would reach the radio's sensitivity if only distance took some of it: with
    // both antennas at their best, and without ground, obstacles, shadowing and fading.
    bool is_in_steady_reach(const Transmission& sent, RadioId radio, const Position& place) const;
    // In m. Farther away, no member of the group is in steady reach.
    double steady_reach_m(const Transmission& sent, const ReceiverGroup& group) const;
    // Whether a radio in steady reach always has the power of its distance.
    bool is_power_law() const { return antennas_.all_isotropic() && propagation_.is_power_law(); }

    bool all_isotropic() const { return antennas_.all_isotropic(); }
    bool is_random() const { return propagation_.is_random(); }
    // A bound before path loss: sent power in W times the maximum gains of both antennas.
    double max_power_w(const Transmission& sent, const ReceiverGroup& group) const {
        const double in_band_w = sent.power_w * sent.band.share_in(group.band);
        return antennas_.all_isotropic()
                   ? in_band_w
                   : in_band_w * antennas_.max_gain(sent.radio) * group.max_antenna_gain;
    }
    // Bound, up to rounding, for the path gain (a linear ratio) at that distance and beyond.
    double max_gain_beyond(double distance_m, double carrier_hz) const {
        return propagation_.max_gain_beyond(distance_m, carrier_hz);
    }
    // In m. Farther away, no member of the group notices the transmission on its own.
    double reach_m(ReceiverGroup& group, const Transmission& sent) const {
        return known_reach_m(group.reach, sent, group, group.min_noticed_w(sent));
    }
    // In m. Farther away, no member of the group receives that power.
    double reach_of_power_m(const Transmission& sent, const ReceiverGroup& group, double power_w) const;
    // The same, cached in `known`.
    double known_reach_m(KnownReach& known, const Transmission& sent, const ReceiverGroup& group,
                         double power_w) const;
    // In m. At all members nearer than this, the transmission alone exceeds the ED threshold. 0 if
    // that depends on more than the distance.
    double ed_radius_m(const Transmission& sent, const ReceiverGroup& group) const;

private:
    static constexpr std::uint32_t max_parameter_sets = 0x7FFFFFFF;  // more than any network has radios
    // State that each transmission reads of the radios near it. Small, because memory access
    // dominates in large networks.
    struct alignas(32) Radio {
        MediumListener* listener = nullptr;
        const void* interface_target = nullptr;
        const void* protocol_target = nullptr;
        std::uint32_t stream = 0;           // of its interface (InterfaceId)
        std::uint32_t parameters : 31 = 0;  // index into `parameters_`
        std::uint32_t watches_energy : 1 = 1;
    };

    std::uint32_t parameters_index(const ReceiverParameters& parameters);
    std::uint32_t group_index(const ReceiverParameters& parameters);

    Propagation propagation_;
    Antennas antennas_;
    std::vector<Radio> radios_;                    // [radio]
    std::vector<const Trajectory*> trajectories_;  // [radio]
    std::vector<ReceiverParameters> parameters_;
    std::vector<std::uint32_t> group_of_;  // [parameters]
    std::vector<RadioId> first_radio_;     // [node]; the node's other radios follow it
    std::deque<ReceiverGroup> groups_;
    DisplacementBound displacement_;
};

}  // namespace netsim
