// Observer of every frame of a network and its outcome at each receiver. It does not change the run.
// Without an observer, the cost is one test per frame and reception.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "netsim/node_id.hpp"
#include "netsim/trace/frame_label.hpp"
#include "netsim/trace/power_budget.hpp"

namespace netsim {

struct Transmission;  // propagation/transmission.hpp
enum class FrameOutcome : std::uint8_t;

class FrameObserver {
public:
    virtual ~FrameObserver() = default;

    struct Interferer {
        NodeId node = 0;
        double power_w = 0;  // at the receiver
    };
    // Why a receiver lost a frame.
    struct Loss {
        NodeId receiver = 0;
        double power_w = 0;
        PowerBudget budget{};  // of that power; sent_w is 0 on a medium without powers
        // Of a frame that was too weak: the receiver's sensitivity in W, or the least power of its
        // preamble detection. Otherwise the SNIR, a ratio, that detection needs, or with which half
        // of such headers or frames survive.
        double needed = 0;
        // Both are 0 if the frame was too weak, whatever the noise.
        double noise_w = 0;
        double interference_w = 0;              // 0 if the frame was lost to noise
        std::vector<Interferer> interferers{};  // strongest first
    };

    // Whether losses between these nodes are of interest. For others, none need be computed.
    virtual bool explains(NodeId sender, NodeId receiver) const = 0;
    // A frame starts. For `noticed` of its receptions, reception_ends will be called. `too_weak` are
    // below the sensitivity. `missed` are those of them that distance alone does not explain, and
    // that of the destination.
    virtual void frame_begins(const Transmission& transmission, std::uint64_t noticed, std::uint64_t too_weak,
                              std::span<const Loss> missed) = 0;
    virtual void reception_ends(FrameNumber number, NodeId receiver, FrameOutcome outcome) = 0;
    // Called before reception_ends, for a reception that ends with the frame and is lost.
    virtual void frame_lost(FrameNumber number, const Loss& loss) = 0;
};

}  // namespace netsim
