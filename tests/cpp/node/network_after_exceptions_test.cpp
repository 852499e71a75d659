#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/node/network.hpp"
#include "support/recorder.hpp"
#include "support/silent_node.hpp"

namespace netsim {
namespace {

using test::Recorder;
using test::silent_node;

TEST(NetworkAfterExceptions, AReceiverThatThrewFindsItsChannelFree) {
    Network network(MediumConfig(), 1);
    Recorder& sender = test::add_recorder(network, silent_node());
    Recorder& receiver = test::add_recorder(network, silent_node({10, 0, 0}));
    sender.on_initialize = [](Recorder& self) { self.broadcast("text"); };
    receiver.on_packet = [](Recorder&, const std::string&) { throw std::runtime_error("of the protocol"); };
    network.initialize();
    EXPECT_THROW(network.run_until(SimTime::from_seconds(1)), std::runtime_error);
    receiver.broadcast("answer");
    network.run_until(SimTime::from_seconds(1));
    EXPECT_EQ(sender.packet_texts(), std::vector<std::string>{"answer"});
}

}  // namespace
}  // namespace netsim
