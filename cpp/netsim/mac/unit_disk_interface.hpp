// A perfect channel: all nodes within the sender's range get the message. No interference, no loss.
//
// With instant timing, they get it at the instant it is sent, by the same rules as in prototype mode.
// This separates the logic of a protocol from the effects of the radio. With airtime, they get it at
// the end of its frame, after the propagation delay. With channel access, a frame also waits in a
// queue until the channel is free around its sender (UnitDiskTiming).
//
//   send() -> WAITING --the channel is free, and this sender is the first to see it--> ON THE AIR
//
// The range is inclusive, and evaluated at the start of the frame. All interfaces share one channel:
// those of a node differ only in their range. Frames never collide: a node can receive several at
// once, and while it transmits.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/instant_count.hpp"
#include "netsim/kernel/prefetch.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/mac/frame_fifo.hpp"
#include "netsim/mac/network_interface.hpp"
#include "netsim/mac/unit_disk_timing.hpp"
#include "netsim/mobility/trajectory.hpp"
#include "netsim/trace/frame_fates.hpp"
#include "netsim/trace/message_fates.hpp"

namespace netsim {

class UnitDiskInterface;

// The first interface of each node of one network, by node id.
struct UnitDiskChannel {
    std::vector<UnitDiskInterface*> interfaces;
    FrameNumber frame_count = 0;
};

class UnitDiskInterface final : public NetworkInterface {
public:
    UnitDiskInterface(Simulator& simulator, UnitDiskChannel& channel, InterfaceId interface, double range_m,
                      UnitDiskTiming timing, const Trajectory& trajectory, FrameFates& frame_fates,
                      Fingerprint& fingerprint);
    UnitDiskInterface(const UnitDiskInterface&) = delete;
    UnitDiskInterface& operator=(const UnitDiskInterface&) = delete;

    // Also throws SimulationError for endless replies at one instant.
    void send(NodeId destination, Payload payload, CauseId cause) override;
    void prefetch(int /*step*/) const override { netsim::prefetch(*this); }
    std::size_t longest_message_bytes() const override { return std::numeric_limits<std::size_t>::max(); }
    const MessageFates& message_fates() const override { return message_fates_; }
    std::size_t queued_messages() const override { return queue_.size() + on_air_; }

private:
    double squared_distance_to(const UnitDiskInterface& other) const;
    bool reaches(double squared_distance_m2) const { return squared_distance_m2 <= range_m_ * range_m_; }
    void wait_for_channel();
    void access_channel();
    void transmit(const std::shared_ptr<const Frame>& frame);
    void end_exchange(MessageKind kind, MessageFate fate);
    void deliver(std::size_t flight);
    // The time when the channel around this node becomes free. The node's interfaces share it.
    SimTime& free_at() { return channel_.interfaces[id_]->free_at_; }

    Simulator& simulator_;
    UnitDiskChannel& channel_;
    double range_m_;
    UnitDiskTiming timing_;
    const Trajectory& trajectory_;
    FrameFates& frame_fates_;
    Fingerprint& fingerprint_;
    NodeId id_;
    InstantCount sent_;
    MessageFates message_fates_;
    FrameFifo queue_;         // frames that wait for the channel
    bool waits_ = false;      // whether an event will check the channel
    std::size_t on_air_ = 0;  // number of exchanges that have not ended
    SimTime free_at_;

    struct Flight {  // a message between the start of its frame and its delivery
        std::shared_ptr<const Frame> frame;
        FrameNumber number = 0;
        UnitDiskInterface* receiver = nullptr;
    };
    std::vector<Flight> flights_;
    std::vector<std::size_t> free_flights_;
};

}  // namespace netsim
