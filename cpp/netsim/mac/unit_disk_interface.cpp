#include "netsim/mac/unit_disk_interface.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/propagation/transmission.hpp"
#include "netsim/units.hpp"

namespace netsim {

UnitDiskInterface::UnitDiskInterface(Simulator& simulator, UnitDiskChannel& channel, InterfaceId interface,
                                     double range_m, UnitDiskTiming timing, const Trajectory& trajectory,
                                     FrameFates& frame_fates, Fingerprint& fingerprint)
    : simulator_(simulator),
      channel_(channel),
      range_m_(range_m),
      timing_(timing),
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
    if (timing_.is_instant() && sent_.exceeds(simulator_.now())) {
        throw SimulationError("node " + std::to_string(id_) + " has sent " + std::to_string(max_per_instant) +
                              " messages at " + std::to_string(simulator_.now().seconds()) +
                              " s on a medium without delay: time stands still; expected answers that end");
    }
    const int psdu_bytes = timing_.psdu_bytes(static_cast<int>(payload->size()));
    auto frame = std::make_shared<const Frame>(
        Frame{.kind = destination == broadcast_id ? FrameKind::broadcast : FrameKind::unicast,
              .transmitter = id_,
              .receiver = destination,
              .psdu_bytes = psdu_bytes,
              .payload = std::move(payload),
              .cause = cause,
              .accepted = simulator_.now()});
    const MessageKind kind = message_kind(*frame);
    message_fates_.accept(kind);
    if (!timing_.waits_for_channel()) {
        transmit(frame);
    } else if (queue_.size() >= static_cast<std::size_t>(timing_.queue_capacity())) {
        message_fates_.book(kind, MessageFate::queue_overflow);
    } else {
        queue_.push(std::move(frame));
        wait_for_channel();
    }
}

void UnitDiskInterface::wait_for_channel() {
    if (waits_ || queue_.empty()) {
        return;
    }
    waits_ = true;
    simulator_.schedule_at(std::max(free_at(), simulator_.now()), [this] { access_channel(); });
}

void UnitDiskInterface::access_channel() {
    waits_ = false;
    if (free_at() > simulator_.now()) {
        wait_for_channel();
        return;
    }
    const std::shared_ptr<const Frame> frame = queue_.front();
    queue_.pop();
    transmit(frame);
    // In two events, so that senders that start waiting during this transmission come first.
    if (!queue_.empty()) {
        waits_ = true;
        simulator_.schedule_at(free_at(), [this] {
            waits_ = false;
            wait_for_channel();
        });
    }
}

void UnitDiskInterface::transmit(const std::shared_ptr<const Frame>& frame) {
    const FrameLabel label{frame->kind, frame->receiver, channel_.frame_count++};
    const SimTime airtime = timing_.airtime(frame->kind, frame->psdu_bytes);
    const SimTime exchange = airtime + timing_.response(frame->kind);
    fingerprint_.add(static_cast<std::uint64_t>(simulator_.now().ps()));
    fingerprint_.add(static_cast<std::uint64_t>(id_));
    CopyCount addressed;
    for (UnitDiskInterface* receiver : channel_.interfaces) {
        const bool is_addressed = receiver->id_ != id_ && label.is_for(receiver->id_);
        if (!is_addressed && !timing_.waits_for_channel()) {
            continue;
        }
        const double squared_distance_m2 = squared_distance_to(*receiver);
        if (timing_.waits_for_channel() && reaches(squared_distance_m2)) {
            receiver->free_at_ = std::max(receiver->free_at_, simulator_.now() + exchange + timing_.gap());
        }
        if (!is_addressed) {
            continue;
        }
        ++addressed.made;
        if (!reaches(squared_distance_m2)) {
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
        const SimTime delay =
            timing_.is_instant() ? SimTime{}
                                 : SimTime::from_seconds(std::sqrt(squared_distance_m2) / speed_of_light_mps);
        simulator_.schedule_after(airtime + delay, [this, flight] { deliver(flight); });
    }
    if (FrameObserver* const observer = frame_fates_.observer(); observer != nullptr) {
        Transmission transmission;
        transmission.start = simulator_.now();
        transmission.duration = airtime;
        transmission.sender = {id_, 0};
        transmission.label = label;
        if (!timing_.is_instant()) {
            transmission.psdu_bytes = frame->psdu_bytes;
            transmission.mode = &timing_.mode(frame->kind);
        }
        transmission.frame = frame;
        observer->frame_begins(transmission, addressed.made - addressed.too_weak, addressed.too_weak);
    }
    frame_fates_.book_transmission(label, addressed, CopyCount{});
    const MessageFate fate = frame->kind == FrameKind::broadcast ? MessageFate::sent
                             : addressed.too_weak == 0           ? MessageFate::acknowledged
                                                                 : MessageFate::out_of_range;
    ++on_air_;
    if (timing_.is_instant()) {
        end_exchange(message_kind(*frame), fate);
    } else {
        simulator_.schedule_after(exchange,
                                  [this, kind = message_kind(*frame), fate] { end_exchange(kind, fate); });
    }
}

void UnitDiskInterface::end_exchange(MessageKind kind, MessageFate fate) {
    --on_air_;
    message_fates_.book(kind, fate);
}

// Squared, as in prototype mode: with rounded square roots, nodes exactly at the range would differ.
double UnitDiskInterface::squared_distance_to(const UnitDiskInterface& other) const {
    const SimTime now = simulator_.now();
    return squared_distance(other.trajectory_.position_at(now), trajectory_.position_at(now));
}

void UnitDiskInterface::deliver(std::size_t flight) {
    const Flight landed = std::move(flights_[flight]);
    free_flights_.push_back(flight);
    frame_fates_.book(landed.receiver->id_, {landed.frame->kind, landed.frame->receiver, landed.number},
                      FrameFate::delivered);
    landed.receiver->pass_on_message(*landed.frame);
}

}  // namespace netsim
