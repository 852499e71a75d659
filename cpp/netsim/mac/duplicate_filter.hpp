// Detects a data frame that was received before, because its ACK was lost and its sender repeated it.
//
// Source: IEEE 802.11-2020, 10.3.2.14 (duplicate detection): a retry with the sequence number of the
// last frame from the same transmitter is a duplicate. 802.15.4 frames do not have a retry bit
// (frame_802154.hpp). There, a new frame has the number of the last one only if the 255 frames
// between them were lost.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "netsim/mac/frame.hpp"

namespace netsim {

class DuplicateFilter {
public:
    // Returns whether the frame repeats the last one of its transmitter. Remembers it as the last one.
    bool is_duplicate(const Frame& frame) {
        const auto [last, is_new] = last_sequence_.try_emplace(frame.transmitter, frame.sequence);
        if (is_new) {
            return false;
        }
        const bool repeated = frame.retry && last->second == frame.sequence;
        last->second = frame.sequence;
        return repeated;
    }

private:
    std::unordered_map<NodeId, std::uint32_t> last_sequence_;
};

}  // namespace netsim
