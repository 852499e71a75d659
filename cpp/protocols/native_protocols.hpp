// The table of native protocols, for `protocol.typename` in an .ini file.
//
// This directory is a library on top of the engine. To add a protocol, add its file here, and one
// line to native_protocols.cpp. docs/how-to/write-a-native-protocol.md has the details.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "protocols/parameter.hpp"

namespace netsim {

// In the order in which they are listed to users.
const std::vector<NativeProtocol>& native_protocols();

// Sets the protocol of that name on `node`. Throws ConfigError for an invalid name, parameter or
// value.
void set_native_protocol(Node& node, std::string_view name, const Parameters& parameters = {});

}  // namespace netsim
