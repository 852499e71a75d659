// The native protocols: the table that `protocol.typename` of an .ini file is looked up in.
//
// To add a protocol: its own file in this folder, and one line in native_protocols.cpp.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "netsim/node/protocols/parameter.hpp"

namespace netsim {

// In the order in which lists show them.
const std::vector<NativeProtocol>& native_protocols();

// Gives `node` the protocol of that name. Throws ConfigError for a name, a parameter or a value that makes no sense.
void set_native_protocol(Node& node, std::string_view name, const Parameters& parameters = {});

}  // namespace netsim
