// The air between the radios of one network: propagation, path loss, noise and interference.
//
// A radio is told only of arrivals that can matter to it: those that it could lock on to or that make its channel busy;
// together with others on the air at the same time only as long as it watches for that. All other transmissions are
// remembered for as long as they can interfere with a reception, and summed when one ends. The result is that
// of the plain model, in which every radio hears of everything; the cost is that of the radios near by.
//
// What gets where is known to the links (links.hpp), what is on the air to the airwaves (airwaves.hpp), and where transmissions
// matter only together to the watch over energy (energy_watch.hpp). Here they come together, and radios are told.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/medium/airwaves.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/background_noise.hpp"
#include "netsim/medium/energy_watch.hpp"
#include "netsim/medium/interference.hpp"
#include "netsim/medium/links.hpp"
#include "netsim/medium/receiver.hpp"
#include "netsim/propagation/transmission.hpp"
#include "netsim/trace/frame_fates.hpp"

namespace netsim {

// Of which arrivals the radios are told: `everything` is the plain model, slow and obvious, which tests hold
// the other one against.
enum class Hearing { what_matters, everything };

class Medium final : private EnergyListener {
public:
    // `seed` is that of the run, for fading.
    Medium(Simulator& simulator, const MediumConfig& config, FrameFates& fates, Fingerprint& fingerprint,
           Hearing hearing = Hearing::what_matters, std::uint64_t seed = 0);
    Medium(const Medium&) = delete;
    Medium& operator=(const Medium&) = delete;

    // Radio ids are given in the order of attaching: 0, 1, …, node by node: all interfaces of node 0, those of node 1, …
    // No node may have two radios of one centre frequency.
    RadioId attach(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna = {});
    // What each arrival at the radio touches in the layers above it (Links::set_touched).
    void set_touched(RadioId radio, const void* interface, const void* protocol) {
        links_.set_touched(radio, interface, protocol);
    }

    // A radio that watches its energy is also told of frames of which none is loud enough alone, but that make its channel busy
    // together. All watch from the start; one may stop and begin again. Returns when such frames last ceased to keep its
    // channel busy, if that was after `since`; otherwise, also if they still do, long ago. `since` lies no farther back than
    // was asked to `remember`.
    SimTime watch_energy(RadioId radio, SimTime since);
    void stop_watching_energy(RadioId radio) { links_.set_watches_energy(radio, false); }
    // Keeps transmissions for at least that long after their end; of several durations asked for, the longest counts.
    void remember(SimTime duration) { remembered_ = std::max(remembered_, duration); }

    // The radio will probably send soon: has what the medium knows of it brought into the cache (kernel/fetch.hpp).
    void fetch_sender(RadioId radio) const { links_.fetch_sender(radio); }
    // Puts a frame on the air now, at the sender's present position, and sees to its arrivals.
    // `transmission`'s id, start and origin are filled in here.
    void transmit(Transmission transmission);

    // What disturbs `arrival` at `receiver` from `start` until just before `end`. Only until the arrival has ended, and
    // for times until now; valid until the next call.
    InterferenceSum& interference_with(RadioId receiver, const Arrival& arrival, SimTime start, SimTime end);

    // In W, no less than its largest sum over the time of the arrival, for one that reached the sensitivity: known at
    // once. Infinite if that says nothing.
    double most_interference_w(const Arrival& arrival) const { return arrival.on_air->others_w; }
    // The same at that receiver, once the arrival has ended: nearer to the truth, and more to work out.
    double most_interference_w(RadioId receiver, const Arrival& arrival) const;

    Simulator& simulator() const { return simulator_; }
    // To which the radios add, too.
    FrameFates& fates() { return fates_; }
    Fingerprint& fingerprint() { return fingerprint_; }
    const BackgroundNoise& background_noise() const { return background_noise_; }
    // Transmissions on the air, or over but able to disturb a reception that is not: stays small, as tests
    // check.
    std::size_t remembered_count() const { return airwaves_.size(); }
    // How often the power of a transmission at a radio was worked out for sums of energy: even where very many overlap,
    // a few times for each pair of them, as tests check.
    std::uint64_t energy_look_count() const { return energy_watch_.look_count(); }

private:
    struct Due {
        SimTime time;
        Turn turn = 0;
    };
    void tell_everybody(OnAir& entry);
    void tell_those_it_matters_to(OnAir& entry);
    // Of one audience: who can notice it, in `heard`, and whom its ring watches. Returns the copies that it makes there.
    CopyCount find_those_it_matters_to(OnAir& entry, std::size_t index);
    // Those `near` the sender, without it, by whether they are within that distance of it: those in `within_` may notice
    // the transmission, those in `beyond_` not without others beside it. Has what is known of each fetched.
    void part(std::span<const Neighbours::Near> near, const Transmission& sent, double noticed_m);
    void book_copies(const OnAir& entry, CopyCount copies);
    void fetch(RadioId radio, FrameKind kind) const;
    void schedule_arrivals(OnAir& entry);
    // Of the next one to start or to end.
    static Due next_due(const OnAir& entry, OnAir::Edge edge);
    void schedule_next(OnAir& entry, OnAir::Edge edge);
    void tell_next(OnAir& entry, OnAir::Edge edge);
    // Of an arrival that it does not notice alone, or in the plain model.
    void tell(RadioId radio, OnAir& on_air, const Arrival& arrival);
    void begin(RadioId radio, const OnAir& on_air, std::size_t apart);
    // Adds what `there` can bring to the receivers of `here`.
    void bound_interference(OnAir& here, const OnAir& there) const;
    void energy_matters(RadioId radio, OnAir& on_air, const Arrival& arrival) override;

    Simulator& simulator_;
    FrameFates& fates_;
    Fingerprint& fingerprint_;
    Links links_;
    Airwaves airwaves_;         // on links_
    EnergyWatch energy_watch_;  // over both
    BackgroundNoise background_noise_;
    Hearing hearing_;
    SimTime remembered_;            // after their end
    InterferenceSum interference_;  // the answer of interference_with, reused
    std::vector<OnAir*> beside_;
    std::vector<Heard> spare_;  // to put others in order
    // The answer of part, reused.
    std::vector<const Neighbours::Near*> within_;
    std::vector<const Neighbours::Near*> beyond_;
};

}  // namespace netsim
