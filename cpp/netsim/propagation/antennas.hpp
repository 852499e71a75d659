// The antennas of all radios, and the gain of both ends of a link. Used by the medium.
#pragma once

#include <memory>
#include <vector>

#include "netsim/propagation/antenna_pattern.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

class Antennas {
public:
    // Adds the antenna of the next radio: 0, 1, … `trajectory`: of its node.
    void add(const MountedAntenna& antenna, const Trajectory& trajectory) {
        const bool is_isotropic = antenna.pattern == nullptr;
        all_isotropic_ = all_isotropic_ && is_isotropic;
        mounted_.push_back(is_isotropic ? nullptr : std::make_unique<Mounted>(antenna, &trajectory));
    }

    // If so, every gain is 1.
    bool all_isotropic() const { return all_isotropic_; }
    double max_gain(RadioId radio) const { return mounted_[radio] ? mounted_[radio]->antenna.max_gain() : 1; }

    // The product of the sender's gain towards the receiver, at `place` when the transmission
    // starts, and the receiver's gain towards the sender, with their orientations at that time.
    double gain(const Transmission& sent, RadioId receiver, const Position& place) const {
        return sender_gain(sent, place) * receiver_gain(sent, receiver, place);
    }
    double sender_gain(const Transmission& sent, const Position& place) const {
        return gain_towards(place - sent.origin, sent.radio, sent.start);
    }
    double receiver_gain(const Transmission& sent, RadioId receiver, const Position& place) const {
        return gain_towards((place - sent.origin) * -1, receiver, sent.start);
    }

private:
    struct Mounted {
        Mounted(const MountedAntenna& mounted_antenna, const Trajectory* its_trajectory)
            : antenna(mounted_antenna), trajectory(its_trajectory) {}

        MountedAntenna antenna;
        const Trajectory* trajectory;
    };

    double gain_towards(const Position& way, RadioId radio, SimTime time) const {
        const Mounted* mounted = mounted_[radio].get();
        return mounted == nullptr ? 1 : mounted->antenna.gain_towards(way, *mounted->trajectory, time);
    }

    std::vector<std::unique_ptr<Mounted>> mounted_;  // null: isotropic
    bool all_isotropic_ = true;
};

}  // namespace netsim
