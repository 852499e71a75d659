// A perfect channel: all nodes within the sender's range get the message, at the instant it is
// sent.
//
// No airtime, no interference, no loss: the same rules as the channel of prototype mode. It
// separates the logic of a protocol from the effects of the radio. The range is inclusive, and
// evaluated when the message is sent. All interfaces share one channel: those of a node differ only
// in their range.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/instant_count.hpp"
#include "netsim/kernel/prefetch.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/mac/network_interface.hpp"
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
                      const Trajectory& trajectory, FrameFates& frame_fates, Fingerprint& fingerprint);
    UnitDiskInterface(const UnitDiskInterface&) = delete;
    UnitDiskInterface& operator=(const UnitDiskInterface&) = delete;

    // Also throws SimulationError if messages answer each other endlessly at one instant.
    void send(NodeId destination, Payload payload, CauseId cause) override;
    void prefetch(int /*step*/) const override { netsim::prefetch(*this); }
    std::size_t longest_message_bytes() const override { return std::numeric_limits<std::size_t>::max(); }
    const MessageFates& message_fates() const override { return message_fates_; }
    std::size_t queued_messages() const override { return 0; }

private:
    bool reaches(const UnitDiskInterface& other) const;
    void deliver(std::size_t flight);

    Simulator& simulator_;
    UnitDiskChannel& channel_;
    double range_m_;
    const Trajectory& trajectory_;
    FrameFates& frame_fates_;
    Fingerprint& fingerprint_;
    NodeId id_;
    InstantCount sent_;
    MessageFates message_fates_;

    struct Flight {  // a message between its sending and its delivery within the same instant
        std::shared_ptr<const Frame> frame;
        FrameNumber number = 0;
        UnitDiskInterface* receiver = nullptr;
    };
    std::vector<Flight> flights_;
    std::vector<std::size_t> free_flights_;
};

}  // namespace netsim
