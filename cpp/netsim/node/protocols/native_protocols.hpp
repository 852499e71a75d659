// The table of native protocols, for `protocol.typename` in an .ini file.
//
// To add a protocol, add its file to this directory, and one line to native_protocols.cpp.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "netsim/node/protocols/parameter.hpp"

namespace netsim {

// In the order in which they are listed to users.
const std::vector<NativeProtocol>& native_protocols();

// Sets the protocol of that name on `node`. Throws ConfigError for an invalid name, parameter or
// value.
void set_native_protocol(Node& node, std::string_view name, const Parameters& parameters = {});

}  // namespace netsim
