// Observer of every frame of a network and its outcome at each receiver. It does not change the run.
// Without an observer, the cost is one test per frame and reception.
#pragma once

#include <cstdint>
#include <span>

#include "netsim/node_id.hpp"
#include "netsim/trace/frame_label.hpp"

namespace netsim {

struct Transmission;  // propagation/transmission.hpp
enum class FrameFate : std::uint8_t;

class FrameObserver {
public:
    virtual ~FrameObserver() = default;

    // The loss of a frame that a receiver was locked on to.
    struct Loss {
        double power_w = 0;
        double interference_w = 0;              // 0: lost to noise
        std::span<const NodeId> interferers{};  // strongest first
    };

    // A frame starts. For `noticed` of its receptions, reception_ends will be called. `too_weak` are
    // below the sensitivity.
    virtual void frame_begins(const Transmission& transmission, std::uint64_t noticed,
                              std::uint64_t too_weak) = 0;
    virtual void reception_ends(FrameNumber number, NodeId receiver, FrameFate fate) = 0;
    // Called before reception_ends, for a reception that ends with the frame and is lost.
    virtual void frame_lost(FrameNumber number, NodeId receiver, const Loss& loss) = 0;
};

}  // namespace netsim
