// The frames that wait for the channel: first in, first out; a full queue drops the newcomer.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "netsim/mac/frame.hpp"

namespace netsim {

class TxQueue {
public:
    explicit TxQueue(int capacity) : capacity_(static_cast<std::size_t>(capacity)) {}

    // False if it was full and the frame is dropped.
    bool push(std::shared_ptr<const Frame> frame) {
        if (size() >= capacity_) {
            return false;
        }
        frames_.push_back(std::move(frame));
        return true;
    }
    std::shared_ptr<const Frame> pop() {
        std::shared_ptr<const Frame> frame = std::move(frames_[taken_++]);
        if (2 * taken_ >= frames_.size()) {  // so that a frame is moved once, on average
            frames_.erase(frames_.begin(), frames_.begin() + static_cast<std::ptrdiff_t>(taken_));
            taken_ = 0;
        }
        return frame;
    }
    bool empty() const { return size() == 0; }
    std::size_t size() const { return frames_.size() - taken_; }

private:
    std::size_t capacity_;
    // Not a deque, which takes half a kilobyte even while it is empty.
    std::vector<std::shared_ptr<const Frame>> frames_;
    std::size_t taken_ = 0;  // of them, at the front
};

}  // namespace netsim
