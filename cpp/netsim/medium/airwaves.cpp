#include "netsim/medium/airwaves.hpp"

#include <algorithm>
#include <utility>

namespace netsim {

OnAir& Airwaves::put(Transmission transmission, SimTime now, Turn first_turn) {
    if (spare_.empty()) {
        spare_.push_back(std::make_unique<OnAir>());
    }
    entries_.push_back(std::move(spare_.back()));
    spare_.pop_back();
    OnAir& entry = *entries_.back();
    entry.transmission = std::move(transmission);
    entry.transmission.id = next_id_++;
    entry.transmission.start = now;
    entry.transmission.origin = links_.position(entry.transmission.radio, now);
    entry.last_end = now;
    entry.ring_m = 0;
    entry.reach_m = 0;
    entry.arrives_at_once = false;
    entry.others_w = 0;
    entry.close.clear();
    entry.far_w = 0;
    entry.first_turn = first_turn;
    entry.odometer_m = links_.odometer().reading_m(now);
    entry.heard.clear();
    entry.places.clear();
    entry.told = {};
    entry.heard_is_complete = false;
    entry.told_apart.clear();
    entry.shares.clear();
    for (const Audience& audience : links_.audiences()) {
        entry.shares.push_back(entry.transmission.band.share_in(audience.band));
    }
    entry.rings.resize(links_.audiences().size());
    return entry;
}

void Airwaves::forget_the_past(SimTime now, SimTime remembered) {
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

void Airwaves::find_those_beside(const OnAir& newest, std::vector<OnAir*>& beside) const {
    // Without a branch, as a processor cannot guess which of them are over.
    beside.resize(entries_.size());
    std::size_t count = 0;
    for (const std::unique_ptr<OnAir>& other : entries_) {
        beside[count] = other.get();
        count += static_cast<std::size_t>(other->transmission.id < newest.transmission.id) &
                 static_cast<std::size_t>(other->last_end > newest.transmission.start);
    }
    beside.resize(count);
}

}  // namespace netsim
