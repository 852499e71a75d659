#include "netsim/medium/active_transmissions.hpp"

#include <algorithm>
#include <utility>

namespace netsim {

ActiveTransmission& ActiveTransmissions::put(Transmission transmission, SimTime now,
                                             SequenceNumber first_sequence_number) {
    if (spare_.empty()) {
        spare_.push_back(std::make_unique<ActiveTransmission>());
    }
    entries_.push_back(std::move(spare_.back()));
    spare_.pop_back();
    ActiveTransmission& entry = *entries_.back();
    entry.transmission = std::move(transmission);
    entry.transmission.label.number = next_id_++;
    entry.transmission.start = now;
    entry.transmission.origin = links_.position(entry.transmission.radio, now);
    entry.last_end = now;
    entry.zone_radius_m = 0;
    entry.reach_m = 0;
    entry.arrives_immediately = false;
    entry.max_interference_w = 0;
    entry.close_interferers.clear();
    entry.max_far_interference_w = 0;
    entry.first_sequence_number = first_sequence_number;
    entry.displacement_m = links_.displacement().total_m(now);
    entry.scheduled.clear();
    entry.places.clear();
    entry.notified = {};
    entry.arrivals_are_scheduled = false;
    entry.late_arrivals.clear();
    entry.shares.clear();
    for (const ReceiverGroup& group : links_.groups()) {
        entry.shares.push_back(entry.transmission.band.share_in(group.band));
    }
    entry.zones.resize(links_.groups().size());
    return entry;
}

void ActiveTransmissions::forget_ended(SimTime now, SimTime remembered) {
    const auto active = std::find_if(entries_.begin(), entries_.end(),
                                     [now](const auto& entry) { return entry->last_end >= now; });
    const SimTime needed_from =
        std::min(now - remembered, active == entries_.end() ? now : (*active)->transmission.start);
    auto first = entries_.begin();
    for (; first != entries_.end() && (*first)->last_end < needed_from; ++first) {
        (*first)->transmission.frame.reset();
        spare_.push_back(std::move(*first));
    }
    entries_.erase(entries_.begin(), first);
}

void ActiveTransmissions::find_concurrent(const ActiveTransmission& newest,
                                          std::vector<ActiveTransmission*>& concurrent) const {
    // Branch-free: the processor cannot predict which of them have ended.
    concurrent.resize(entries_.size());
    std::size_t count = 0;
    for (const std::unique_ptr<ActiveTransmission>& other : entries_) {
        concurrent[count] = other.get();
        count += static_cast<std::size_t>(other->transmission.id() < newest.transmission.id()) &
                 static_cast<std::size_t>(other->last_end > newest.transmission.start);
    }
    concurrent.resize(count);
}

}  // namespace netsim
