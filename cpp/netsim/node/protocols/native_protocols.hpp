// The table of native protocols, for `protocol.typename` in an .ini file.
//
// To add a protocol: its own file in this folder, and one line in native_protocols.cpp.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "netsim/node/protocols/parameter.hpp"

namespace netsim {

// In the order of listings.
const std::vector<NativeProtocol>& native_protocols();

// Sets the protocol of that name on `node`. Throws ConfigError for an invalid name, parameter or
// value.
void set_native_protocol(Node& node, std::string_view name, const Parameters& parameters = {});

}  // namespace netsim
