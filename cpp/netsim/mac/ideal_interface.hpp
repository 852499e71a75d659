// An interface without a MAC: nodes get a message if its frame reaches them alone, whatever else is on the air.
//
// This separates the logic of a protocol, and each effect of the radio, from the others. Two settings of the medium
// decide what happens to a frame. `timing` says what takes time:
//
//   instant        nothing: messages arrive at the instant they are sent, by the same rules as in prototype mode
//   airtime        frames, and their way at the speed of light
//   aloha          the same, but a node sends one frame after the other, and frames that overlap at a receiver are lost
//   channelAccess  a frame also waits in a queue until the channel is free around its sender (IdealTiming)
//
//   send() -> WAITING --the channel is free, and this sender is the first to see it--> ON THE AIR
//
// The type of the medium says whom a frame reaches. On the unit disk: all nodes within the sender's range, which is
// inclusive, and evaluated at the start of the frame. All interfaces share one channel there, and those of a node differ
// only in their range. On other media: the radios that would decode it alone (IdealRadio), with path loss, noise,
// obstacles and antennas.
//
// Frames collide only with `aloha`. Otherwise a node can receive several at once, and while it transmits. There, as at a
// real radio, a frame is lost if the receiver transmits meanwhile; on the unit disk, if any other frame overlaps; and on
// other media by the error model, with the largest sum of the powers that overlap.
//
// A unicast frame that a radio loses is sent again after its ACK is missing, up to the retry limit; with `aloha` after a
// random delay. ACKs are never lost.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/instant_count.hpp"
#include "netsim/kernel/prefetch.hpp"
#include "netsim/kernel/random.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/mac/frame_fifo.hpp"
#include "netsim/mac/ideal_timing.hpp"
#include "netsim/mac/network_interface.hpp"
#include "netsim/mac/slots.hpp"
#include "netsim/medium/links.hpp"
#include "netsim/mobility/trajectory.hpp"
#include "netsim/phy/radio_model.hpp"
#include "netsim/trace/frame_outcomes.hpp"
#include "netsim/trace/message_outcomes.hpp"

namespace netsim {

class IdealInterface;

// What the interfaces of one network share.
struct IdealChannel {
    std::vector<IdealInterface*> interfaces;  // the first of each node, by node id
    std::optional<Links> links;               // between the radios; none on the unit disk
    std::vector<IdealInterface*> by_radio;    // by the ids of `links`
    FrameNumber frame_count = 0;
    SimTime longest_airtime;
};

// The radio of an interface on a medium with powers. Its receiver options other than preamble detection have no effect.
struct IdealRadio {
    std::shared_ptr<const RadioModel> model;
    double tx_power_w = 0;
    PpduFormats formats = PpduFormats::all();
    const Attitude& attitude;
};

class IdealInterface final : public NetworkInterface {
public:
    // `radio`: none on the unit disk, where `range_m` counts instead. `seed`: of the run.
    IdealInterface(Simulator& simulator, IdealChannel& channel, InterfaceId interface, double range_m,
                   std::optional<IdealRadio> radio, IdealTiming timing, const Trajectory& trajectory,
                   FrameOutcomes& frame_outcomes, Fingerprint& fingerprint, std::uint64_t seed);
    IdealInterface(const IdealInterface&) = delete;
    IdealInterface& operator=(const IdealInterface&) = delete;

    // Also throws SimulationError for endless replies at one instant.
    void send(NodeId destination, Payload payload, CauseId cause) override;
    void prefetch(int /*step*/) const override { netsim::prefetch(*this); }
    std::size_t longest_message_bytes() const override { return std::numeric_limits<std::size_t>::max(); }
    const MessageOutcomes& message_outcomes() const override { return message_outcomes_; }
    std::size_t queued_messages() const override { return queue_.size() + on_air_; }

private:
    // A message on its way: from its first attempt to its outcome.
    struct Exchange {
        std::shared_ptr<const Frame> frame;
        int attempts = 0;
        bool is_heard = false;
        bool is_received = false;
    };
    // The frame of an attempt at one receiver.
    struct Reach {
        IdealInterface* receiver = nullptr;  // null: no radio of the node can decode it
        bool is_heard = false;               // whether it reaches the receiver at all
        bool occupies = false;               // whether it makes the channel busy there
        SimTime delay;
        Arrival arrival;  // with `radio_` only
    };
    // A frame at a receiver that hears it, until its end.
    struct Flight {
        std::size_t exchange = 0;  // of the sender
        std::shared_ptr<const Transmission> sent;
        IdealInterface* receiver = nullptr;
        Arrival arrival;
    };
    // Of the own frames, and of those that arrive: what collides.
    struct Stretch {
        SimTime start;
        SimTime end;
        double power_w = 0;
        NodeId sender = 0;
        FrameNumber number = 0;
    };

    bool is_full() const;
    // Whether one message waits in front of the full queue, so that it has begun to block, or will end.
    bool has_one_in_front() const;
    void wait_for_channel();
    void access_channel();
    void transmit(std::size_t exchange);
    // Adds what an observer gets of a frame that is below the receiver's sensitivity.
    void add_missed(const Transmission& sent, const IdealInterface& receiver, const Position& place,
                    std::vector<FrameObserver::Loss>& missed) const;
    Transmission transmission_of(const std::shared_ptr<const Frame>& frame, SimTime airtime);
    Reach reach_at(const IdealInterface& first_of_node, const Transmission& sent) const;
    void end_exchange(std::size_t number);
    void deliver(std::size_t flight);
    void add_stretch(std::vector<Stretch>& stretches, const Stretch& added) const;
    FrameOutcome outcome_of(const Flight& flight);
    // The most that other systems add to the noise during a frame, in W. Unlike the MAC's radio, this interface
    // takes the most of noise and interference together, even if they have it at different times.
    double other_systems_w(const Arrival& arrival) const {
        return radio_ ? radio_->model->medium.other_systems().max_w(stream_, arrival.start, arrival.end) : 0;
    }
    void book_loss(const Flight& flight, FrameOutcome outcome, double interference_w,
                   std::span<const FrameObserver::Interferer> interferers);
    double draw() { return RandomStream(seed_, stream_, Purpose::reception, drawn_++).uniform(); }
    // The interface whose own frames this one cannot hear: on the unit disk, those of a node share a channel.
    IdealInterface& shared_channel() { return radio_ ? *this : *channel_.interfaces[id_]; }
    // The time when the channel around this node becomes free. The node's interfaces share it.
    SimTime& free_at() { return channel_.interfaces[id_]->free_at_; }

    Simulator& simulator_;
    IdealChannel& channel_;
    double range_m_;
    std::optional<IdealRadio> radio_;
    RadioId radio_id_ = 0;
    IdealTiming timing_;
    const Trajectory& trajectory_;
    FrameOutcomes& frame_outcomes_;
    Fingerprint& fingerprint_;
    std::uint64_t seed_;
    NodeId id_;
    std::uint32_t stream_;
    std::uint64_t drawn_ = 0;
    RandomStream delays_;  // before retries
    InstantCount sent_;
    MessageOutcomes message_outcomes_;
    FrameFifo queue_;         // frames that wait for the channel
    bool waits_ = false;      // whether an event will check the channel
    std::size_t on_air_ = 0;  // number of exchanges that have not ended
    SimTime free_at_;
    std::vector<Stretch> own_;      // with `aloha` only: the last frames that this node sent
    std::vector<Stretch> arrived_;  // and those that it heard
    Slots<Exchange> exchanges_;
    Slots<Flight> flights_;
};

}  // namespace netsim
