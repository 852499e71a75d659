#include "protocols/native_protocols.hpp"

#include <algorithm>
#include <string>

#include "netsim/config/nearest_name.hpp"
#include "netsim/error.hpp"
#include "protocols/beacon_protocol.hpp"
#include "protocols/flood_protocol.hpp"
#include "protocols/saturating_source.hpp"
#include "protocols/sink_protocol.hpp"
#include "protocols/zigzag_ground_station_protocol.hpp"
#include "protocols/zigzag_mobile_protocol.hpp"
#include "protocols/zigzag_sensor_protocol.hpp"

namespace netsim {

const std::vector<NativeProtocol>& native_protocols() {
    static const std::vector<NativeProtocol> table{
        BeaconProtocol::description(),
        FloodProtocol::description(),
        SaturatingSource::description(),
        SinkProtocol::description(),
        ZigZagMobileProtocol::description(),
        ZigZagSensorProtocol::description(),
        ZigZagGroundStationProtocol::description(),
    };
    return table;
}

void set_native_protocol(Node& node, std::string_view name, const Parameters& parameters) {
    const std::vector<NativeProtocol>& table = native_protocols();
    const auto row = std::find_if(table.begin(), table.end(),
                                  [name](const NativeProtocol& each) { return each.name == name; });
    if (row == table.end()) {
        std::vector<std::string_view> names;
        for (const NativeProtocol& each : table) {
            names.push_back(each.name);
        }
        throw ConfigError("there is no native protocol `" + std::string(name) + "`; did you mean `" +
                          std::string(nearest_name(name, names)) + "`?");
    }
    node.set_protocol(row->make(node, parameters));
}

}  // namespace netsim
