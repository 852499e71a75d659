// The pending events of a large simulation that are not due for a while: by the slice of time in which they are due, in
// no order within it.
//
// A heap of all pending events costs the more the more there are, and most are timers, of which it sorts all each time
// one is taken out. So the queue keeps in its heap only those of the slices that have been opened, and opens the next
// one when these are used up. Slices are of one length; what is due after the last of them lies aside until all are
// used up and the time that follows is cut into slices in its turn.
//
// Source: W. T. Tang, R. S. M. Goh, I. L.-J. Thng, "Ladder queue: an O(1) priority queue structure for large-scale discrete
// event simulation", ACM TOMACS 15 (3), 2005; this is one rung of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "netsim/kernel/event_key.hpp"

namespace netsim {

class FarEvents {
public:
    // Whether an event of that time belongs here. Until `take_all`, none does.
    bool is_far(std::int64_t time_ps) const { return time_ps >= begin_ps_ && slice_of(time_ps) >= opened_; }
    void add(const EventKey& key) {
        const std::uint64_t slice = slice_of(key.time_ps);
        (slice < slices_.size() ? slices_[slice] : later_).push_back(key);
        ++size_;
    }
    bool is_in_use() const { return is_in_use_; }
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }

    // From now on events are far until the slice of their time is opened. `keys`, of which there is one at least, is left
    // empty. Only once.
    void take_all(std::vector<EventKey>& keys);
    // Moves those that are due first to `keys`. Only when not empty.
    void open_next(std::vector<EventKey>& keys);

    template <typename Predicate>
    void erase_if(const Predicate& predicate) {
        size_ = 0;
        for (std::vector<EventKey>& slice : slices_) {
            std::erase_if(slice, predicate);
            size_ += slice.size();
        }
        std::erase_if(later_, predicate);
        size_ += later_.size();
    }

private:
    // Of a time that is not before `begin_ps_`. Beyond the last one it is that of a later time.
    std::uint64_t slice_of(std::int64_t time_ps) const {
        return static_cast<std::uint64_t>(time_ps - begin_ps_) >> shift_;
    }
    void cut_anew();

    static constexpr std::size_t slice_count = 256;

    bool is_in_use_ = false;
    std::int64_t begin_ps_ = std::numeric_limits<std::int64_t>::max();  // of the first slice
    unsigned shift_ = 63;                                               // slices are 2^shift ps long
    std::uint64_t opened_ = 1;                                          // so many of them
    std::array<std::vector<EventKey>, slice_count> slices_;
    std::vector<EventKey> later_;
    std::size_t size_ = 0;
};

}  // namespace netsim
