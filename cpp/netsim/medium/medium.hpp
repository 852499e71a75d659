// The medium between the radios of one network: propagation, path loss, noise and interference.
//
// A radio is notified only of relevant arrivals: those that it can lock on to, and those that make
// its channel busy, alone or, while the radio watches for that, together with others. The medium
// keeps all other transmissions for as long as they can interfere with a reception, and sums them
// when a reception ends. The results equal those of the plain model, in which every radio is
// notified of every arrival. The cost depends only on the radios nearby.
//
// Links computes what each radio receives of a transmission (links.hpp). ActiveTransmissions stores
// what is on the air (active_transmissions.hpp). CumulativeEnergyDetection finds where several
// transmissions make a channel busy together (cumulative_energy_detection.hpp). The medium combines
// them and notifies the radios.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/medium/active_transmissions.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/background_noise.hpp"
#include "netsim/medium/cumulative_energy_detection.hpp"
#include "netsim/medium/interference.hpp"
#include "netsim/medium/links.hpp"
#include "netsim/medium/other_systems.hpp"
#include "netsim/medium/receiver.hpp"
#include "netsim/propagation/transmission.hpp"
#include "netsim/trace/frame_outcomes.hpp"

namespace netsim {

// Whether radios are notified of relevant arrivals only. `disabled` is the plain model: slow, but
// obviously correct. Tests compare the two.
enum class Culling { enabled, disabled };

class Medium final : private CumulativeEnergyListener {
public:
    // `seed`: of the run, for fading.
    Medium(Simulator& simulator, const MediumConfig& config, FrameOutcomes& outcomes,
           Fingerprint& fingerprint, Culling culling = Culling::enabled, std::uint64_t seed = 0);
    Medium(const Medium&) = delete;
    Medium& operator=(const Medium&) = delete;

    // Returns the radio's id: 0, 1, … in the order of calls. Attach all interfaces of node 0, then
    // those of node 1, and so on. A node must not have two radios with the same center frequency.
    RadioId attach(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna = {});
    // Links::set_prefetch_targets.
    void set_prefetch_targets(RadioId radio, const void* interface, const void* protocol) {
        links_.set_prefetch_targets(radio, interface, protocol);
    }

    // Starts cumulative energy detection at the radio: it is also notified of frames that exceed its
    // ED threshold only together. Initially on. Returns when such frames last stopped keeping the
    // channel busy after `since`; long ago if they did not. `since` must be within the time set by
    // `remember`.
    SimTime watch_energy(RadioId radio, SimTime since);
    void stop_watching_energy(RadioId radio) { links_.set_watches_energy(radio, false); }
    // Keeps transmissions for at least that long after their end. The longest duration of all calls
    // counts.
    void remember(SimTime duration) { remembered_ = std::max(remembered_, duration); }

    // The radio will probably send soon: prefetches what the medium reads of it
    // (kernel/prefetch.hpp).
    void prefetch_sender(RadioId radio) const { links_.prefetch_sender(radio); }
    // Puts a frame on the air now, at the sender's position, and schedules its arrivals. Fills in
    // the id, start and origin of `transmission`.
    void transmit(Transmission transmission);

    // The interference with `arrival` at `receiver` from `start` until just before `end`, which must
    // not be in the future. Call it before or in arrival_ended. Valid until the next call.
    InterferenceSum& interference_with(RadioId receiver, const Arrival& arrival, SimTime start, SimTime end);

    // What became of the power of that arrival.
    PowerBudget power_budget(RadioId receiver, const Arrival& arrival) const {
        return links_.power_budget(*arrival.transmission, receiver, arrival.place);
    }

    // An upper bound in W for that interference over the whole arrival, which must reach the
    // receiver's sensitivity. O(1). Infinite if no bound is known.
    double max_interference_w(const Arrival& arrival) const { return arrival.active->max_interference_w; }
    // A tighter bound at that receiver, for an arrival that has ended. More expensive.
    double max_interference_w(RadioId receiver, const Arrival& arrival) const;

    Simulator& simulator() const { return simulator_; }
    // The radios add to these, too.
    FrameOutcomes& outcomes() { return outcomes_; }
    Fingerprint& fingerprint() { return fingerprint_; }
    const BackgroundNoise& background_noise() const { return background_noise_; }
    const OtherSystems& other_systems() const { return other_systems_; }
    // Number of transmissions on the air, or ended but kept. Tests check that it stays small.
    std::size_t remembered_count() const { return active_transmissions_.size(); }
    // How often the power of a transmission at a radio was computed for sums of energy. Tests check
    // that it is a few times per pair of overlapping transmissions, even if very many overlap.
    std::uint64_t energy_evaluation_count() const { return energy_detection_.evaluation_count(); }

private:
    struct Due {
        SimTime time;
        SequenceNumber number = 0;
    };
    void notify_all(ActiveTransmission& entry);
    void find_all_receivers(ActiveTransmission& entry);
    // Finds the receivers of one group. Those that notice the transmission go to `scheduled`, and
    // watching ones to its watch zones. Returns the group's numbers of receptions.
    CopyCount find_receivers(ActiveTransmission& entry, std::size_t index);
    // Splits `near` by distance to the sender, without the sender. Receivers in `within_` may notice
    // the transmission, those in `beyond_` only together with others. Prefetches the state of each.
    void partition(std::span<const NeighborSearch::Neighbor> near, const Transmission& sent,
                   double noticed_m);
    void notify_observer(const Transmission& sent, CopyCount copies);
    // The receptions below the sensitivity that an observer gets (FrameObserver::frame_begins).
    std::vector<FrameObserver::Loss> missed_receptions(const Transmission& sent,
                                                       const FrameObserver& observer);
    void book_copies(const ActiveTransmission& entry, CopyCount copies);
    void prefetch(RadioId radio, FrameKind kind) const;
    void schedule_arrivals(ActiveTransmission& entry);
    static Due next_due(const ActiveTransmission& entry, ActiveTransmission::Edge edge);
    void schedule_next(ActiveTransmission& entry, ActiveTransmission::Edge edge);
    void notify_next(ActiveTransmission& entry, ActiveTransmission::Edge edge);
    // Notifies the radio of an arrival that it does not notice alone, or of any arrival if culling
    // is disabled.
    void notify(RadioId radio, ActiveTransmission& active, const Arrival& arrival);
    void start_late_arrival(RadioId radio, const ActiveTransmission& active, std::size_t index);
    void add_interference_bounds(ActiveTransmission& here, const ActiveTransmission& there) const;
    void arrival_needed(RadioId radio, ActiveTransmission& active, const Arrival& arrival) override;

    Simulator& simulator_;
    FrameOutcomes& outcomes_;
    Fingerprint& fingerprint_;
    Links links_;
    ActiveTransmissions active_transmissions_;    // on links_
    CumulativeEnergyDetection energy_detection_;  // over both
    BackgroundNoise background_noise_;
    OtherSystems other_systems_;
    Culling culling_;
    SimTime remembered_;            // how long transmissions are kept after their end
    InterferenceSum interference_;  // result of interference_with, reused
    std::vector<ActiveTransmission*> concurrent_;
    std::vector<ScheduledArrival> spare_;  // working memory of sort_arrivals
    // Result of partition, reused.
    std::vector<const NeighborSearch::Neighbor*> within_;
    std::vector<const NeighborSearch::Neighbor*> beyond_;
};

}  // namespace netsim
