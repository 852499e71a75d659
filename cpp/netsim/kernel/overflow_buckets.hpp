// The events of a large simulation that are not due for a while, in buckets by time, unsorted
// within a bucket.
//
// The cost of a heap grows with the number of pending events, most of which are timers due later.
// So the event queue keeps only the events of opened buckets in its heap, and opens the next bucket
// when these have run. All buckets cover equal time spans. Events after the last bucket wait in an
// overflow list, which is divided into new buckets when all buckets are used up.
//
// Source: W. T. Tang, R. S. M. Goh, I. L.-J. Thng, "Ladder queue: an O(1) priority queue structure
// for large-scale discrete event simulation", ACM TOMACS 15 (3), 2005; this is one rung of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "netsim/kernel/event_key.hpp"

namespace netsim {

class OverflowBuckets {
public:
    // Whether an event of that time belongs here, not in the heap. Until `take_all`, none does.
    bool belongs_here(std::int64_t time_ps) const {
        return time_ps >= begin_ps_ && bucket_of(time_ps) >= opened_;
    }
    void add(const EventKey& key) {
        const std::uint64_t bucket = bucket_of(key.time_ps);
        (bucket < buckets_.size() ? buckets_[bucket] : beyond_).push_back(key);
        ++size_;
    }
    bool is_in_use() const { return is_in_use_; }
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }

    // Takes over all `keys`, at least one, and leaves `keys` empty. From now on, events belong here
    // until the bucket of their time is opened. Call it once.
    void take_all(std::vector<EventKey>& keys);
    // Moves the events of the first bucket to `keys`. Only when not empty.
    void open_next(std::vector<EventKey>& keys);

    template <typename Predicate>
    void erase_if(const Predicate& predicate) {
        size_ = 0;
        for (std::vector<EventKey>& bucket : buckets_) {
            std::erase_if(bucket, predicate);
            size_ += bucket.size();
        }
        std::erase_if(beyond_, predicate);
        size_ += beyond_.size();
    }

private:
    // The bucket of a time not before `begin_ps_`; past the last bucket for later times.
    std::uint64_t bucket_of(std::int64_t time_ps) const {
        return static_cast<std::uint64_t>(time_ps - begin_ps_) >> shift_;
    }
    void rebuild();

    static constexpr std::size_t bucket_count = 256;

    bool is_in_use_ = false;
    std::int64_t begin_ps_ = std::numeric_limits<std::int64_t>::max();  // of the first bucket
    unsigned shift_ = 63;                                               // a bucket spans 2^shift ps
    std::uint64_t opened_ = 1;                                          // number of opened buckets
    std::array<std::vector<EventKey>, bucket_count> buckets_;
    std::vector<EventKey> beyond_;
    std::size_t size_ = 0;
};

}  // namespace netsim
