#include "netsim/kernel/overflow_buckets.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "netsim/error.hpp"

namespace netsim {

void OverflowBuckets::take_all(std::vector<EventKey>& keys) {
    NETSIM_ASSERT(!is_in_use_);
    is_in_use_ = true;
    beyond_.swap(keys);
    size_ = beyond_.size();
    rebuild();
}

void OverflowBuckets::open_next(std::vector<EventKey>& keys) {
    NETSIM_ASSERT(!empty());
    if (size_ == beyond_.size()) {
        rebuild();
    }
    while (buckets_[opened_].empty()) {
        ++opened_;
    }
    // Frees the memory of the bucket. The bucket to be opened next collects most new events, so
    // every bucket would keep the capacity for that.
    const std::vector<EventKey> bucket = std::exchange(buckets_[opened_++], {});
    keys.insert(keys.end(), bucket.begin(), bucket.end());
    size_ -= bucket.size();
}

// Half of the events go to the first half of the buckets. The others may be much later; those past
// the last bucket wait. For any distribution of times, each event is visited twice on average.
void OverflowBuckets::rebuild() {
    NETSIM_ASSERT(!beyond_.empty());
    opened_ = 0;
    const auto by_time = [](const EventKey& one, const EventKey& other) {
        return one.time_ps < other.time_ps;
    };
    const auto median = beyond_.begin() + static_cast<std::ptrdiff_t>(beyond_.size() / 2);
    std::nth_element(beyond_.begin(), median, beyond_.end(), by_time);
    begin_ps_ = std::min_element(beyond_.begin(), median + 1, by_time)->time_ps;
    const auto half_ps = static_cast<std::uint64_t>(median->time_ps - begin_ps_);
    shift_ = static_cast<unsigned>(std::bit_width(half_ps / (bucket_count / 2)));
    std::vector<EventKey> all = std::exchange(beyond_, {});
    size_ = 0;
    for (const EventKey& key : all) {
        add(key);
    }
}

}  // namespace netsim
