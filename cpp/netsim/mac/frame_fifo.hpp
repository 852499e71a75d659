// A FIFO of frames that needs little memory: the storage of a TransmitQueue.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "netsim/mac/frame.hpp"

namespace netsim {

class FrameFifo {
public:
    void push(std::shared_ptr<const Frame> frame) {
        if (!first_) {
            first_ = std::move(frame);
            return;
        }
        if (!others_) {
            others_ = std::make_unique<Others>();
        }
        others_->frames.push_back(std::move(frame));
    }
    // Only when not empty, like pop.
    std::shared_ptr<const Frame>& front() { return first_; }
    const std::shared_ptr<const Frame>& front() const { return first_; }
    void pop() { first_ = others_ ? others_->take() : nullptr; }
    bool empty() const { return !first_; }
    std::size_t size() const { return (first_ ? 1 : 0) + (others_ ? others_->size() : 0); }

private:
    // Not a deque, which takes half a kilobyte even when empty.
    struct Others {
        std::vector<std::shared_ptr<const Frame>> frames;
        std::size_t taken = 0;  // number of removed frames at the front

        std::size_t size() const { return frames.size() - taken; }
        // Null if there is none.
        std::shared_ptr<const Frame> take() {
            if (size() == 0) {
                return nullptr;
            }
            std::shared_ptr<const Frame> frame = std::move(frames[taken++]);
            if (2 * taken >= frames.size()) {  // then each frame is moved at most once on average
                frames.erase(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(taken));
                taken = 0;
            }
            return frame;
        }
    };

    // Null only if there are no others. Usually the only frame, stored without an allocation.
    std::shared_ptr<const Frame> first_;
    std::unique_ptr<Others> others_;  // null until there are two frames
};

}  // namespace netsim
