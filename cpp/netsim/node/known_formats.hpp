// The PPDU formats that an interface can decode: those of its operation mode.
#pragma once

#include "netsim/config/interface_config.hpp"
#include "netsim/phy/modes.hpp"
#include "netsim/propagation/ppdu_format.hpp"

namespace netsim {

// Throws ConfigError for an operation mode that does not exist.
inline PpduFormats known_formats(const InterfaceConfig& interface) {
    return interface.type_name == ieee802154_interface ? PpduFormats{PpduFormat::oqpsk}
                                                       : mode_set(interface.mac.op_mode).formats();
}

}  // namespace netsim
