// The air between the radios of one network: propagation, path loss, noise and interference.
//
// A radio is told only of arrivals that can matter to it: those that it could lock on to or that make its
// channel busy, alone or together with others on the air at the same time. All other transmissions are
// remembered for as long as they can interfere with a reception, and summed when one ends. The result is that
// of the plain model, in which every radio hears of everything.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/medium/path_loss.hpp"
#include "netsim/medium/transmission.hpp"
#include "netsim/mobility/trajectory.hpp"
#include "netsim/trace/frame_fates.hpp"

namespace netsim {

// The side of a radio that the medium speaks to.
class MediumListener {
public:
    virtual void arrival_started(const Arrival& arrival) = 0;
    virtual void arrival_ended(const Arrival& arrival) = 0;

protected:
    ~MediumListener() = default;
};

// What the medium must know of a receiver.
struct Receiver {
    MediumListener* listener = nullptr;
    const Trajectory* trajectory = nullptr;
    Band band;
    double sensitivity_w = 0;       // the least power it can lock on to
    double energy_detection_w = 0;  // noise and signals together that make its channel busy
};

// What disturbed one reception.
struct Interference {
    double max_power_w = 0;  // the largest sum over the time of the reception, without background noise
    std::vector<NodeId> interferers;  // each once, in the order of their transmissions
};

// Of which arrivals the radios are told: `everything` is the plain model, slow and obvious, which tests hold
// the other one against.
enum class Hearing { what_matters, everything };

class Medium {
public:
    Medium(Simulator& simulator, const MediumConfig& config, FrameFates& fates, Fingerprint& fingerprint,
           Hearing hearing = Hearing::what_matters);

    // Node ids are given in the order of attaching: 0, 1, …
    NodeId attach(const Receiver& receiver);

    // Puts a frame on the air now, at the sender's present position, and sees to its arrivals.
    // `transmission`'s id, start and origin are filled in here.
    void transmit(Transmission transmission);

    // What disturbs `arrival` at `receiver`. Only while the arrival is ending.
    const Interference& interference_with(NodeId receiver, const Arrival& arrival);

    double background_noise_w() const { return background_noise_w_; }
    // Transmissions on the air, or over but able to disturb a reception that is not: stays small, as tests
    // check.
    std::size_t remembered_count() const { return on_air_.size(); }

private:
    // A receiver, and how far away it can hear a transmission of the last power and carrier asked for. Kept
    // because the comparison of squared distances spares the path loss of all who are too far away.
    struct Attached {
        Receiver receiver;
        double tx_power_w = 0;
        double carrier_hz = 0;
        double squared_reach_m2 = 0;
    };
    struct OnAir {
        Transmission transmission;
        SimTime last_end;                // at its most distant receiver
        Place first_place;               // of its arrivals' events, two for each receiver
        std::vector<NodeId> told_later;  // receivers to whom it came to matter only with later transmissions
    };

    Arrival arrival_at(const Transmission& transmission, const Receiver& receiver) const;
    // False only if no receiver gets `newest` while another frame is still arriving there.
    bool may_overlap(const Transmission& newest) const;
    // Beyond that, a transmission without others beside it cannot matter to the receiver.
    double squared_reach_m2(Attached& attached, const Transmission& transmission) const;
    void tell(NodeId node, const OnAir& on_air, const Arrival& arrival);
    void begin(NodeId node, const OnAir& on_air, const Arrival& arrival);
    void tell_if_energy_adds_up(NodeId node, OnAir& newest, const Arrival& arrival);
    bool is_told_alone(const Receiver& receiver, double power_w) const {
        return hearing_ == Hearing::everything || power_w >= receiver.sensitivity_w ||
               background_noise_w_ + power_w >= receiver.energy_detection_w;
    }
    void forget_the_past();

    Simulator& simulator_;
    FrameFates& fates_;
    Fingerprint& fingerprint_;
    PathLoss path_loss_;
    double background_noise_w_;
    Hearing hearing_;
    std::vector<Attached> attached_;
    std::deque<OnAir> on_air_;  // by start; pointers to its elements stay valid until they are forgotten
    std::uint64_t next_id_ = 0;
    Interference interference_;         // the answer of interference_with, reused
    std::vector<Arrival> overlapping_;  // its working memory
    std::vector<std::pair<OnAir*, Arrival>> together_;
};

}  // namespace netsim
