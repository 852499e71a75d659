// The text of messages that say nothing: as many octets as were asked for, and one text for all who ask for as many.
//
// In a large network a text of its own for each node would be in no cache whenever it is sent. Used by the nodes of one network
// together.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "netsim/mac/frame.hpp"

namespace netsim {

class Filler {
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
