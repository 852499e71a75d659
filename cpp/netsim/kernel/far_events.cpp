#include "netsim/kernel/far_events.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "netsim/error.hpp"

namespace netsim {

void FarEvents::take_all(std::vector<EventKey>& keys) {
    NETSIM_ASSERT(!is_in_use_);
    is_in_use_ = true;
    later_.swap(keys);
    size_ = later_.size();
    cut_anew();
}

void FarEvents::open_next(std::vector<EventKey>& keys) {
    NETSIM_ASSERT(!empty());
    if (size_ == later_.size()) {
        cut_anew();
    }
    while (slices_[opened_].empty()) {
        ++opened_;
    }
    // Its memory goes with it: just before it is opened, a slice may have taken what is due in a moment, which is more than
    // the others ever hold.
    const std::vector<EventKey> slice = std::exchange(slices_[opened_++], {});
    keys.insert(keys.end(), slice.begin(), slice.end());
    size_ -= slice.size();
}

// So that half of the events are in the first half of the slices: the others may be very much later, and wait until
// then. Each event is looked at twice on average, however they are spread.
void FarEvents::cut_anew() {
    NETSIM_ASSERT(!later_.empty());
    opened_ = 0;
    const auto by_time = [](const EventKey& one, const EventKey& other) {
        return one.time_ps < other.time_ps;
    };
    const auto median = later_.begin() + static_cast<std::ptrdiff_t>(later_.size() / 2);
    std::nth_element(later_.begin(), median, later_.end(), by_time);
    begin_ps_ = std::min_element(later_.begin(), median + 1, by_time)->time_ps;
    const auto half_ps = static_cast<std::uint64_t>(median->time_ps - begin_ps_);
    shift_ = static_cast<unsigned>(std::bit_width(half_ps / (slice_count / 2)));
    std::vector<EventKey> all = std::exchange(later_, {});
    size_ = 0;
    for (const EventKey& key : all) {
        add(key);
    }
}

}  // namespace netsim
