#include "netsim/mac/unit_disk_interface.hpp"

#include <string>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

UnitDiskInterface::UnitDiskInterface(Simulator& simulator, UnitDiskChannel& channel, InterfaceId interface,
                                     double range_m, const Trajectory& trajectory, FrameFates& frame_fates,
                                     Fingerprint& fingerprint)
    : simulator_(simulator),
      channel_(channel),
      range_m_(range_m),
      trajectory_(trajectory),
      frame_fates_(frame_fates),
      fingerprint_(fingerprint),
      id_(interface.node) {
    if (interface.index == 0) {
        NETSIM_ASSERT(interface.node == static_cast<NodeId>(channel.interfaces.size()));
        channel.interfaces.push_back(this);
    }
}

void UnitDiskInterface::send(NodeId destination, Payload payload, CauseId cause) {
    if (sent_.exceeds(simulator_.now())) {
        throw SimulationError("node " + std::to_string(id_) + " has sent " + std::to_string(max_per_instant) +
                              " messages at " + std::to_string(simulator_.now().seconds()) +
                              " s on a medium without delay: time stands still; expected answers that end");
    }
    const bool broadcast = destination == broadcast_id;
    const FrameLabel label{broadcast ? FrameKind::broadcast : FrameKind::unicast, destination,
                           channel_.frame_count++};
    const auto frame = std::make_shared<const Frame>(Frame{.kind = label.kind,
                                                           .transmitter = id_,
                                                           .receiver = destination,
                                                           .payload = std::move(payload),
                                                           .cause = cause,
                                                           .accepted = simulator_.now()});
    const MessageKind kind = message_kind(*frame);
    message_fates_.accept(kind);
    fingerprint_.add(static_cast<std::uint64_t>(simulator_.now().ps()));
    fingerprint_.add(static_cast<std::uint64_t>(id_));
    CopyCount addressed;
    for (NodeId node = 0; node < static_cast<NodeId>(channel_.interfaces.size()); ++node) {
        if (node == id_ || !label.is_for(node)) {
            continue;
        }
        UnitDiskInterface* receiver = channel_.interfaces[node];
        ++addressed.made;
        if (!reaches(*receiver)) {
            ++addressed.too_weak;
            continue;
        }
        std::size_t flight = flights_.size();
        if (free_flights_.empty()) {
            flights_.emplace_back();
        } else {
            flight = free_flights_.back();
            free_flights_.pop_back();
        }
        flights_[flight] = Flight{frame, label.number, receiver};
        simulator_.schedule_after(SimTime{}, [this, flight] { deliver(flight); });
    }
    if (FrameObserver* const observer = frame_fates_.observer(); observer != nullptr) {
        Transmission transmission;
        transmission.start = simulator_.now();
        transmission.sender = {id_, 0};
        transmission.label = label;
        transmission.frame = frame;
        observer->frame_begins(transmission, addressed.made - addressed.too_weak, addressed.too_weak);
    }
    frame_fates_.book_transmission(label, addressed, CopyCount{});
    if (broadcast) {
        message_fates_.book(kind, MessageFate::sent);
    } else {
        message_fates_.book(kind,
                            addressed.too_weak == 0 ? MessageFate::acknowledged : MessageFate::out_of_range);
    }
}

bool UnitDiskInterface::reaches(const UnitDiskInterface& other) const {
    const SimTime now = simulator_.now();
    // Squares, as in prototype mode: roots are rounded, so nodes exactly at the range would differ.
    return squared_distance(other.trajectory_.position_at(now), trajectory_.position_at(now)) <=
           range_m_ * range_m_;
}

void UnitDiskInterface::deliver(std::size_t flight) {
    const Flight landed = std::move(flights_[flight]);
    free_flights_.push_back(flight);
    frame_fates_.book(landed.receiver->id_, {landed.frame->kind, landed.frame->receiver, landed.number},
                      FrameFate::delivered);
    landed.receiver->pass_on_message(*landed.frame);
}

}  // namespace netsim
