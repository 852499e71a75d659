// A perfect channel: whoever is within the sender's range gets the message, at the instant it is sent.
//
// No airtime, no interference, no loss: the channel of prototype mode (whose rules it follows to the letter), so that
// a protocol's logic can be told apart from what the radio does to it. The range is inclusive and judged at sending.
// There is one channel only: of a node's interfaces it makes no difference through which one a message goes, but for
// their ranges.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "netsim/kernel/fetch.hpp"
#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/instant_count.hpp"
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
};

class UnitDiskInterface final : public NetworkInterface {
public:
    UnitDiskInterface(Simulator& simulator, UnitDiskChannel& channel, InterfaceId interface, double range_m,
                      const Trajectory& trajectory, FrameFates& frame_fates, Fingerprint& fingerprint);
    UnitDiskInterface(const UnitDiskInterface&) = delete;
    UnitDiskInterface& operator=(const UnitDiskInterface&) = delete;

    // Throws SimulationError, too, if messages that answer each other at one instant never end.
    void send(NodeId destination, Payload payload) override;
    void fetch(int /*step*/) const override { netsim::fetch(*this); }
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
        UnitDiskInterface* receiver = nullptr;
    };
    std::vector<Flight> flights_;
    std::vector<std::size_t> free_flights_;
};

}  // namespace netsim
