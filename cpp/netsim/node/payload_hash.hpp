// A number for the text of a message, which stands for it in the fingerprint of the run.
//
// All who hear a broadcast get the same text, mostly one right after the other, and texts are long: so it is worked out
// for the first of them alone. Used by the nodes of one network together.
#pragma once

#include <cstdint>

#include "netsim/kernel/fingerprint.hpp"
#include "netsim/mac/frame.hpp"

namespace netsim {

class PayloadHash {
public:
    // Of equal texts it is the same.
    std::uint64_t of(const Payload& payload) {
        if (payload != last_) {
            Fingerprint hash;
            hash.add_text(*payload);
            value_ = hash.value();
            last_ = payload;
        }
        return value_;
    }

private:
    Payload last_;  // kept, so that no other text comes to lie in its place
    std::uint64_t value_ = 0;
};

}  // namespace netsim
