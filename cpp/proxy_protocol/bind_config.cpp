// The config structs with their declared fields (netsim/config/field.hpp), and the declarations
// themselves. Fields have the same names in Python, except that C++'s type_name is typename.
#include <array>
#include <set>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "netsim/config/field.hpp"
#include "netsim/config/medium_config.hpp"
#include "netsim/config/node_config.hpp"
#include "netsim/config/schema_json.hpp"
#include "netsim/mac/frame_802154.hpp"
#include "netsim/node/known_formats.hpp"
#include "netsim/phy/oqpsk_mode.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;
using namespace netsim;

namespace proxy_protocol {

namespace {

// Binds all declared fields, and validate() if it exists. A typename that sets the defaults of other
// fields is read-only: it is an argument of the constructor.
template <typename Config>
void bind_fields(py::class_<Config>& config) {
    constexpr bool has_fixed_type =
        std::is_same_v<Config, MediumConfig> || std::is_same_v<Config, InterfaceConfig>;
    Config example{};
    for (const Field& field : Config::schema.fields) {
        std::visit(
            [&](auto* value) {
                using Pointer = decltype(value);
                using Value = std::remove_pointer_t<Pointer>;
                const auto of = field.of;
                const auto get = [of](Config& self) -> Value { return *std::get<Pointer>(of(&self)); };
                const auto set = [of](Config& self, const Value& given) {
                    *std::get<Pointer>(of(&self)) = given;
                };
                const std::string name(field.name);
                if (has_fixed_type && name == "typename") {
                    config.def_property_readonly(name.c_str(), get);
                } else {
                    config.def_property(name.c_str(), get, set);
                }
            },
            field.of(&example));
    }
    if constexpr (requires { example.validate(); }) {
        config.def("validate", &Config::validate);
    }
}

}  // namespace

void bind_config(py::module_& module) {
    module.def("schema", [] { return py::module_::import("json").attr("loads")(schema_json()); });

    py::class_<ObstacleConfig> obstacle(module, "ObstacleConfig");
    obstacle.def(py::init<>())
        .def_readwrite("name", &ObstacleConfig::name)
        .def_readwrite("rings", &ObstacleConfig::rings);
    bind_fields(obstacle);

    py::class_<MediumConfig> medium(module, "MediumConfig");
    medium.def(py::init<std::string>(), py::arg("typename") = "Ieee80211ScalarRadioMedium")
        .def_readwrite("obstacles", &MediumConfig::obstacles);
    bind_fields(medium);

    py::class_<AntennaConfig> antenna(module, "AntennaConfig");
    antenna.def(py::init<>()).def("validate", &AntennaConfig::validate, py::arg("carrier_hz"));
    bind_fields(antenna);

    py::class_<RadioConfig> radio(module, "RadioConfig");
    radio.def(py::init<std::string_view>(), py::arg("interface") = ieee80211_interface)
        .def_readwrite("antenna", &RadioConfig::antenna);
    bind_fields(radio);

    py::class_<MacConfig> mac(module, "MacConfig");
    mac.def(py::init<>());
    bind_fields(mac);

    py::class_<CsmaConfig> csma(module, "CsmaConfig");
    csma.def(py::init<>()).def_property_readonly("ack_end_s", [](const CsmaConfig& config) {
        return config.sifs_s + oqpsk_250_kbps.duration(narrowband_ack_bytes).seconds();
    });
    bind_fields(csma);

    py::class_<MobilityConfig> mobility(module, "MobilityConfig");
    mobility.def(py::init<>());
    bind_fields(mobility);

    py::class_<ComputerConfig> computer(module, "ComputerConfig");
    computer.def(py::init<>());
    bind_fields(computer);

    py::class_<WindConfig> wind(module, "WindConfig");
    wind.def(py::init<>());
    bind_fields(wind);

    py::class_<InterfaceConfig> interface(module, "InterfaceConfig");
    interface.def_readwrite("radio", &InterfaceConfig::radio)
        .def_readwrite("mac", &InterfaceConfig::mac)
        .def_readwrite("csma", &InterfaceConfig::csma)
        .def_property_readonly("known_formats", [](const InterfaceConfig& config) {
            std::set<std::string> names;
            for (std::size_t format = 0; format < ppdu_format_names.size(); ++format) {
                if (known_formats(config).contains(static_cast<PpduFormat>(format))) {
                    names.insert(ppdu_format_names[format]);
                }
            }
            return names;
        });
    bind_fields(interface);

    py::class_<NodeConfig>(module, "NodeConfig")
        .def(py::init<std::string, const std::vector<std::string>&>(), py::arg("name"),
             py::arg("interfaces") = std::vector<std::string>{std::string(ieee80211_interface)})
        .def_readwrite("name", &NodeConfig::name)
        .def_property_readonly(
            "wlan",  // a tuple: their number is fixed, so that references to them stay valid
            [](const py::object& self) {
                py::tuple interfaces(self.cast<NodeConfig&>().wlan.size());
                for (std::size_t index = 0; index < interfaces.size(); ++index) {
                    interfaces[index] = py::cast(self.cast<NodeConfig&>().wlan[index],
                                                 py::return_value_policy::reference_internal, self);
                }
                return interfaces;
            })
        .def_readwrite("mobility", &NodeConfig::mobility)
        .def_readwrite("wind", &NodeConfig::wind)
        .def_readwrite("computer", &NodeConfig::computer)
        .def_property(
            "initial_position",
            [](const NodeConfig& config) {
                const Position& position = config.initial_position;
                return py::make_tuple(position.x, position.y, position.z);
            },
            [](NodeConfig& config, const std::array<double, 3>& position) {
                config.initial_position = Position{position[0], position[1], position[2]};
            })
        .def("validate", &NodeConfig::validate);
}

}  // namespace proxy_protocol
