// Padding for messages without content: a string of a given size, shared by all calls for the same
// size.
//
// In a large network, a separate string per node would not be in a cache when it is sent.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "netsim/mac/frame.hpp"

namespace netsim {

class PayloadPadding {
public:
    Payload of(std::size_t bytes) {
        if (!last_ || last_->size() != bytes) {
            last_ = std::make_shared<const std::string>(bytes, 'x');
        }
        return last_;
    }

private:
    Payload last_;
};

}  // namespace netsim
