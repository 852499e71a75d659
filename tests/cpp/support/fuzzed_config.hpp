// Configurations decoded from bytes: all models, and numbers of all sizes.
//
// Fields and ranges come from their declarations. Zeros give the defaults. Half of the bytes do not change parts that
// scenarios seldom change; otherwise the checks would reject nearly every configuration. The caller skips rejected ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "netsim/config/medium_config.hpp"
#include "netsim/config/node_config.hpp"
#include "netsim/phy/modes.hpp"
#include "support/byte_reader.hpp"

namespace netsim::test {

class FuzzedConfig {
public:
    explicit FuzzedConfig(ByteReader& bytes) : bytes_(bytes) {}

    MediumConfig medium() {
        MediumConfig config(bytes_.name(medium_type_names));
        if (bytes_.flag()) {
            fields(MediumConfig::schema, &config);
        }
        if (bytes_.flag()) {
            obstacles(config);
        }
        return config;
    }

    NodeConfig node() {
        NodeConfig config("node", {});
        config.initial_position = position();
        do {
            InterfaceConfig& added = config.wlan.emplace_back(interface());
            added.radio.carrier_hz += 5e6 * bytes_.below(6);
            added.radio.bandwidth_hz -= 1e6 * bytes_.below(3);
        } while (config.wlan.size() <= most_interfaces && bytes_.below(4) == 1);
        if (bytes_.flag()) {
            config.mobility.type_name = bytes_.name(mobility_type_names);
            fields(MobilityConfig::schema, &config.mobility);
            fields(WindConfig::schema, &config.wind);
            fields(ComputerConfig::schema, &config.computer);
        }
        config.mobility.telemetry_interval_s = bytes_.flag() ? bytes_.number(1) : 0;
        return config;
    }

    Position position() {
        const double x = bytes_.number(10.0 * bytes_.byte());
        const double y = bytes_.number(10.0 * bytes_.byte());
        return {x, y, bytes_.number(0)};
    }

private:
    // Draws all fields except those whose values depend on others.
    void fields(const Schema& schema, void* config) {
        for (const Field& field : schema.fields) {
            const bool is_elsewhere = field.name == "typename" || field.name == "carrier_hz" ||
                                      field.name == "bandwidth_hz" || field.name == "error_model" ||
                                      field.type.kind == ValueType::Kind::file;
            if (is_elsewhere) {
                continue;
            }
            const Member member = field.of(config);
            if (auto* const* number = std::get_if<double*>(&member)) {
                **number = value(field.type, **number);
            } else if (auto* const* integer = std::get_if<int*>(&member)) {
                **integer = static_cast<int>(finite(value(field.type, **integer), **integer));
            } else if (auto* const* flag = std::get_if<bool*>(&member)) {
                **flag = bytes_.flag() != **flag;
            } else if (auto* const* name = std::get_if<std::string*>(&member);
                       name != nullptr && bytes_.flag()) {
                **name = bytes_.name(field.type.names);
            }
        }
    }

    // Within the bounds, or not a number.
    double value(const ValueType& type, double usual) {
        if ((usual == 0 || usual == type.special) && bytes_.flag()) {
            const bool is_bounded = std::isfinite(type.least) && std::isfinite(type.most);
            usual = is_bounded ? type.least + (type.most - type.least) * bytes_.byte() / 255.0 : 1;
        }
        const double drawn = bytes_.number(usual);
        return drawn == type.special || std::isnan(drawn) ? drawn : std::clamp(drawn, type.least, type.most);
    }

    static double finite(double value, double otherwise) {
        constexpr double most = 1e9;
        return value >= -most && value <= most ? value : otherwise;
    }

    void obstacles(MediumConfig& config) {
        for (std::uint32_t count = bytes_.below(6); count > 0; --count) {
            ObstacleConfig& obstacle = config.obstacles.emplace_back();
            for (std::uint32_t rings = 1 + bytes_.below(2); rings > 0; --rings) {
                obstacle.rings.push_back(ring());
            }
            fields(ObstacleConfig::schema, &obstacle);
            obstacle.base_m = bytes_.number(-1.0 * (bytes_.byte() % 4));
            obstacle.top_m = bytes_.number(1.0 + bytes_.byte());
        }
    }

    // Corners are on the lattice of the nodes' usual positions, so that nodes are on walls and corners.
    Ring ring() {
        const double x = 10.0 * bytes_.byte();
        const double y = 10.0 * bytes_.byte();
        const double size_m = bytes_.number(10.0 * (1 + bytes_.byte() % 32));
        Ring corners{{x, y}, {x + size_m, y}, {x + size_m, y + size_m}, {x, y + size_m}};
        for (std::uint32_t count = bytes_.below(5); count > 0; --count) {
            corners.push_back({bytes_.number(10.0 * bytes_.byte()), bytes_.number(10.0 * bytes_.byte())});
        }
        return corners;
    }

    InterfaceConfig interface() {
        InterfaceConfig config(bytes_.name(interface_type_names));
        if (bytes_.flag()) {
            fields(RadioConfig::schema, &config.radio);
        }
        if (bytes_.flag()) {
            AntennaConfig& antenna = config.radio.antenna;
            antenna.type_name = bytes_.name(antenna_type_names);
            fields(AntennaConfig::schema, &antenna);
            antenna.length_m = bytes_.flag() ? bytes_.between(0, 0.12) : 0;  // less than the wavelength
        }
        if (bytes_.flag()) {
            fields(CsmaConfig::schema, &config.csma);
        }
        if (bytes_.flag()) {
            mac(config.mac);
        }
        if (bytes_.below(4) == 1) {
            config.radio.tx_power_by_bitrate_w = {{bitrate_bps(config.mac.op_mode), bytes_.number(0.1)}};
        }
        return config;
    }

    void mac(MacConfig& mac) {
        fields(MacConfig::schema, &mac);
        mac.bitrate_bps = bitrate_bps(mac.op_mode);
        mac.multicast_bitrate_bps = bitrate_bps(mac.op_mode);
        mac.control_bitrate_bps = bitrate_bps(mac.op_mode);
        mac.initial_rate_bps = bitrate_bps(mac.op_mode);
        for (std::uint32_t count = bytes_.below(4); count > 1; --count) {
            mac.basic_bitrates_bps.push_back(bitrate_bps(mac.op_mode));
        }
        if (bytes_.flag()) {  // so short that it overflows
            mac.queue_capacity = 1 + bytes_.byte() % 4;
        }
    }

    // -1, a bitrate of the operation mode, or any number.
    double bitrate_bps(const std::string& op_mode) {
        const auto modes = mode_set(op_mode).modes();
        const std::uint32_t index = bytes_.below(static_cast<std::uint32_t>(modes.size()));
        return bytes_.number(bytes_.flag() ? static_cast<double>(modes[index].bitrate_bps) : -1);
    }

    ByteReader& bytes_;
};

}  // namespace netsim::test
