// The frames that wait for the channel: first in, first out; a full queue drops the newcomer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "netsim/mac/frame.hpp"

namespace netsim {

class TxQueue {
public:
    explicit TxQueue(int capacity) : capacity_(static_cast<std::uint32_t>(capacity)) {}

    // False if it was full and the frame is dropped.
    bool push(std::shared_ptr<const Frame> frame) {
        if (size() >= capacity_) {
            return false;
        }
        if (!first_) {
            first_ = std::move(frame);
        } else {
            others_.push_back(std::move(frame));
        }
        return true;
    }
    // Of at least one.
    std::shared_ptr<const Frame> pop() {
        std::shared_ptr<const Frame> frame = std::move(first_);
        if (taken_ < others_.size()) {
            first_ = std::move(others_[taken_++]);
            if (2 * std::size_t{taken_} >= others_.size()) {  // so that a frame is moved once, on average
                others_.erase(others_.begin(), others_.begin() + taken_);
                taken_ = 0;
            }
        }
        return frame;
    }
    bool empty() const { return !first_; }
    std::size_t size() const { return (first_ ? 1 : 0) + others_.size() - taken_; }

private:
    std::uint32_t capacity_;
    std::uint32_t taken_ = 0;  // of the others, at the front
    // Null only if there are no others. Mostly it is the only one, and has no place of its own in memory.
    std::shared_ptr<const Frame> first_;
    // Not a deque, which takes half a kilobyte even while it is empty.
    std::vector<std::shared_ptr<const Frame>> others_;
};

}  // namespace netsim
