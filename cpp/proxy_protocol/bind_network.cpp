// The network: building it, running it, reading its results.
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "netsim/node/network.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;
using namespace netsim;

namespace proxy_protocol {

namespace {

template <typename Counts, typename Names>
py::dict named_counts(const Counts& counts, const Names& names) {
    py::dict result;
    for (std::size_t index = 0; index < counts.size(); ++index) {
        result[names[index]] = counts[index];
    }
    return result;
}

py::dict frame_outcomes(const Network& network) {
    py::dict result;
    for (std::size_t index = 0; index < frame_kind_count; ++index) {
        const auto kind = static_cast<FrameKind>(index);
        const std::string name = frame_kind_names[index];
        result[py::str(name)] =
            named_counts(network.frame_outcomes().counts(kind, false), frame_outcome_names);
        if (kind != FrameKind::broadcast) {
            result[py::str(name + " overheard")] =
                named_counts(network.frame_outcomes().counts(kind, true), frame_outcome_names);
        }
    }
    return result;
}

py::dict frame_outcomes_at(const Network& network, NodeId receiver) {
    py::dict result;
    for (std::size_t index = 0; index < frame_kind_count; ++index) {
        const auto kind = static_cast<FrameKind>(index);
        result[frame_kind_names[index]] = named_counts(
            network.frame_outcomes().counts_at(network.node(receiver).id(), kind), frame_outcome_names);
    }
    return result;
}

py::dict interferers_at(const Network& network, NodeId receiver) {
    py::dict result;
    for (const auto& [interferer, copies] :
         network.frame_outcomes().interferers_at(network.node(receiver).id())) {
        result[py::int_(interferer)] = copies;
    }
    return result;
}

py::dict frames_by_bitrate(const Network& network, NodeId node) {
    std::map<std::int64_t, std::uint64_t> sums;
    for (const auto& interface : network.node(node).interfaces()) {
        for (const auto& [bitrate_bps, frames] : interface->frames_by_bitrate()) {
            sums[bitrate_bps] += frames;
        }
    }
    py::dict result;
    for (const auto& [bitrate_bps, frames] : sums) {
        result[py::int_(bitrate_bps)] = frames;
    }
    return result;
}

template <typename Outcomes>
py::dict named_outcomes(const Outcomes& outcomes) {
    py::dict result;
    for (std::size_t index = 0; index < message_kind_count; ++index) {
        result[message_kind_names[index]] =
            named_counts(outcomes.counts(static_cast<MessageKind>(index)), message_outcome_names);
    }
    return result;
}

py::dict message_outcomes(const Network& network) {
    return named_outcomes(network.message_outcomes());
}

py::dict message_outcomes_from(const Network& network, NodeId sender) {
    py::dict result;
    std::size_t index = 0;
    for (const auto& interface : network.node(sender).interfaces()) {
        result[py::str("wlan[" + std::to_string(index++) + "]")] =
            named_outcomes(interface->message_outcomes());
    }
    return result;
}

py::dict message_delays(const Network& network) {
    py::dict result;
    for (std::size_t index = 0; index < message_kind_count; ++index) {
        const DelayHistogram& delays = network.message_delays().of(static_cast<MessageKind>(index));
        if (delays.count() == 0) {
            continue;
        }
        py::list bins;
        for (const DelayHistogram::Bin& bin : delays.bins()) {
            bins.append(py::make_tuple(bin.begin.seconds(), bin.end.seconds(), bin.count));
        }
        result[message_kind_names[index]] =
            py::dict(py::arg("count") = delays.count(), py::arg("sum_s") = delays.sum_s(),
                     py::arg("sum_of_squares_s2") = delays.sum_of_squares_s2(),
                     py::arg("min_s") = delays.min().seconds(), py::arg("max_s") = delays.max().seconds(),
                     py::arg("bins") = py::tuple(bins));
    }
    return result;
}

std::string fingerprint(const Network& network) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(network.fingerprint()));
    return text;
}

}  // namespace

void bind_network(py::module_& module) {
    py::class_<Network>(module, "Network")
        .def(py::init<const MediumConfig&, std::uint64_t>(), py::arg("medium"), py::arg("seed"))
        .def("add_node", &Network::add_node, py::arg("config"), py::return_value_policy::reference_internal)
        .def("capture", &Network::capture, py::arg("node"), py::arg("path"), py::arg("interface") = 0)
        .def("close_captures", &Network::close_captures)
        .def("initialize", &Network::initialize)
        .def(
            "run_until",
            [](Network& network, double time, std::uint64_t max_events) {
                return network.run_until(SimTime::from_seconds(time), max_events);
            },
            py::arg("time"), py::arg("max_events") = ~std::uint64_t{0})
        .def(
            "step", [](Network& network, double time) { return network.step(SimTime::from_seconds(time)); },
            py::arg("time"))
        .def(
            "schedule",
            [](Network& network, double time, py::function callback) {
                network.schedule(SimTime::of_event(time, network.now()),
                                 [callback = std::move(callback)] { callback(); });
            },
            py::arg("time"), py::arg("callback"))
        .def("record", &Network::record, py::arg("recorded"), py::return_value_policy::reference_internal)
        .def("finish", &Network::finish)
        .def("release_protocols", &Network::release_protocols)
        .def_property_readonly("now", [](const Network& network) { return network.now().seconds(); })
        .def_property_readonly("active_node", &Network::active_node)
        .def_property_readonly("event_count", &Network::event_count)
        .def_property_readonly("pending_count", &Network::pending_count)
        .def_property_readonly("fingerprint", &fingerprint)
        .def("frame_outcomes", &frame_outcomes)
        .def("frame_outcomes_at", &frame_outcomes_at, py::arg("receiver"))
        .def("interferers_at", &interferers_at, py::arg("receiver"))
        .def("frames_by_bitrate", &frames_by_bitrate, py::arg("node"))
        .def("message_outcomes", &message_outcomes)
        .def("message_outcomes_from", &message_outcomes_from, py::arg("sender"))
        .def("message_delays", &message_delays);
}

}  // namespace proxy_protocol
