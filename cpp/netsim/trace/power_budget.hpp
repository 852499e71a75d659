// What a link did to the power of one transmission: the factors whose product, with the sent power,
// is the received power. Computed on request, by the models that the medium uses.
#pragma once

#include <cstddef>
#include <vector>

namespace netsim {

struct PowerBudget {
    struct Obstacle {
        std::size_t index = 0;  // in MediumConfig::obstacles
        double gain = 1;        // 0 … 1
    };

    double sent_w = 0;            // in the receiver's band
    double sender_antenna = 1;    // gain towards the receiver, at the start of the transmission
    double receiver_antenna = 1;  // gain towards the sender
    double distance = 1;          // path loss without a ground
    double ground = 1;            // of the two-ray models: over that of the direct ray alone
    double shadowing = 1;
    double fading = 1;
    std::vector<Obstacle> obstacles{};  // those that the straight line crosses

    double received_w() const {
        double power_w = sent_w * sender_antenna * receiver_antenna * distance * ground * shadowing * fading;
        for (const Obstacle& obstacle : obstacles) {
            power_w *= obstacle.gain;
        }
        return power_w;
    }
};

}  // namespace netsim
