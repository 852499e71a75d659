// A hash of the payload of a message, for the fingerprint of the run.
//
// All receivers of a broadcast get the same string, usually one right after the other. So the hash
// is computed only for the first of them. Shared by the nodes of one network.
#pragma once

#include <cstdint>

#include "netsim/kernel/fingerprint.hpp"
#include "netsim/mac/frame.hpp"

namespace netsim {

class PayloadHash {
public:
    // Equal for equal strings.
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
    Payload last_;  // kept alive, so that no other string gets its address
    std::uint64_t value_ = 0;
};

}  // namespace netsim
