// The frames that wait for the channel: first in, first out; a full queue drops the newcomer.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <utility>

#include "netsim/mac/frame.hpp"

namespace netsim {

class TxQueue {
public:
    explicit TxQueue(int capacity) : capacity_(static_cast<std::size_t>(capacity)) {}

    // False if it was full and the frame is dropped.
    bool push(std::shared_ptr<const Frame> frame) {
        if (frames_.size() >= capacity_) {
            return false;
        }
        frames_.push_back(std::move(frame));
        return true;
    }
    std::shared_ptr<const Frame> pop() {
        std::shared_ptr<const Frame> frame = std::move(frames_.front());
        frames_.pop_front();
        return frame;
    }
    bool empty() const { return frames_.empty(); }
    std::size_t size() const { return frames_.size(); }

private:
    std::size_t capacity_;
    std::deque<std::shared_ptr<const Frame>> frames_;
};

}  // namespace netsim
