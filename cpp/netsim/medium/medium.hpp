// The medium between the radios of one network: propagation, path loss, noise and interference.
//
// A radio is notified only of relevant arrivals: those that it can lock on to, and those that make
// its channel busy, alone or, while it watches for that, together with others. All other
// transmissions are kept for as long as they can interfere with a reception, and summed when one
// ends. The results are those of the plain model, in which every radio is notified of every
// arrival. The cost is that of the radios nearby.
//
// Links knows what each radio receives of a transmission (links.hpp), ActiveTransmissions what is
// on the air (active_transmissions.hpp), and CumulativeEnergyDetection where several transmissions
// make a channel busy together (cumulative_energy_detection.hpp). The medium joins them and
// notifies the radios.
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
#include "netsim/medium/receiver.hpp"
#include "netsim/propagation/transmission.hpp"
#include "netsim/trace/frame_fates.hpp"

namespace netsim {

// Whether radios are notified of relevant arrivals only. `disabled` is the plain model: slow and
// obvious. Tests compare the two.
enum class Culling { enabled, disabled };

class Medium final : private CumulativeEnergyListener {
public:
    // `seed`: of the run, for fading.
    Medium(Simulator& simulator, const MediumConfig& config, FrameFates& fates, Fingerprint& fingerprint,
           Culling culling = Culling::enabled, std::uint64_t seed = 0);
    Medium(const Medium&) = delete;
    Medium& operator=(const Medium&) = delete;

    // Returns the radio's id: 0, 1, … in the order of attaching. Attach all interfaces of node 0,
    // then those of node 1, and so on. A node must not have two radios with the same center
    // frequency.
    RadioId attach(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna = {});
    // What an arrival at the radio touches in the layers above it (Links::set_prefetch_targets).
    void set_prefetch_targets(RadioId radio, const void* interface, const void* protocol) {
        links_.set_prefetch_targets(radio, interface, protocol);
    }

    // Starts cumulative energy detection at the radio: it is also notified of frames that exceed
    // its ED threshold only together. It is on at first. Returns when such frames last stopped
    // keeping the channel busy, if that was after `since`. Otherwise, and if they still do, returns
    // long ago. `since` must be within the time set by `remember`.
    SimTime watch_energy(RadioId radio, SimTime since);
    void stop_watching_energy(RadioId radio) { links_.set_watches_energy(radio, false); }
    // Keeps transmissions for at least that long after their end. The longest requested duration
    // counts.
    void remember(SimTime duration) { remembered_ = std::max(remembered_, duration); }

    // The radio will probably send soon: prefetches what the medium reads of it
    // (kernel/prefetch.hpp).
    void prefetch_sender(RadioId radio) const { links_.prefetch_sender(radio); }
    // Puts a frame on the air now, at the sender's position, and schedules its arrivals. Fills in
    // the id, start and origin of `transmission`.
    void transmit(Transmission transmission);

    // The interference with `arrival` at `receiver` from `start` until just before `end`, which is
    // not in the future. Call it before the arrival's end is over. Valid until the next call.
    InterferenceSum& interference_with(RadioId receiver, const Arrival& arrival, SimTime start, SimTime end);

    // An upper bound in W for that interference over the whole arrival, for one that reached the
    // sensitivity. Costs nothing. Infinite if there is no such bound.
    double max_interference_w(const Arrival& arrival) const { return arrival.active->max_interference_w; }
    // A tighter bound at that receiver, once the arrival has ended. Costs more.
    double max_interference_w(RadioId receiver, const Arrival& arrival) const;

    Simulator& simulator() const { return simulator_; }
    // The radios add to these, too.
    FrameFates& fates() { return fates_; }
    Fingerprint& fingerprint() { return fingerprint_; }
    const BackgroundNoise& background_noise() const { return background_noise_; }
    // Transmissions on the air, or ended but able to interfere with an ongoing reception. Tests
    // check that it stays small.
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
    // Finds the receivers of one group: those that notice it go to `scheduled`, others to its watch
    // zones. Returns the group's count for the ledger.
    CopyCount find_receivers(ActiveTransmission& entry, std::size_t index);
    // Splits `near` by distance to the sender, leaving out the sender: receivers in `within_` may
    // notice the transmission, those in `beyond_` only together with others. Prefetches what is
    // known of each.
    void partition(std::span<const NeighborSearch::Neighbor> near, const Transmission& sent,
                   double noticed_m);
    void tell_observer(const Transmission& sent, CopyCount copies) const;
    void book_copies(const ActiveTransmission& entry, CopyCount copies);
    void prefetch(RadioId radio, FrameKind kind) const;
    void schedule_arrivals(ActiveTransmission& entry);
    // The event of the next arrival to start or to end.
    static Due next_due(const ActiveTransmission& entry, ActiveTransmission::Edge edge);
    void schedule_next(ActiveTransmission& entry, ActiveTransmission::Edge edge);
    void notify_next(ActiveTransmission& entry, ActiveTransmission::Edge edge);
    // Notifies the radio of an arrival that it does not notice alone, or of any arrival if culling
    // is disabled.
    void notify(RadioId radio, ActiveTransmission& active, const Arrival& arrival);
    void start_late_arrival(RadioId radio, const ActiveTransmission& active, std::size_t index);
    // Adds a bound for the power of `there` at the receivers of `here`.
    void add_interference_bounds(ActiveTransmission& here, const ActiveTransmission& there) const;
    void arrival_needed(RadioId radio, ActiveTransmission& active, const Arrival& arrival) override;

    Simulator& simulator_;
    FrameFates& fates_;
    Fingerprint& fingerprint_;
    Links links_;
    ActiveTransmissions active_transmissions_;    // on links_
    CumulativeEnergyDetection energy_detection_;  // over both
    BackgroundNoise background_noise_;
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
