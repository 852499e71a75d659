// The recorder of a replay, and its chunks.
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "netsim/node/replay_recorder.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;
using namespace netsim;

namespace proxy_protocol {

namespace {

// The timer name of a native protocol may be invalid UTF-8.
py::str readable(const std::string& text) {
    PyObject* const decoded =
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace");
    if (decoded == nullptr) {
        throw py::error_already_set();
    }
    return py::reinterpret_steal<py::str>(decoded);
}

py::dict as_python(const ReplayChunk& chunk) {
    py::list strings;
    for (const std::string& text : chunk.strings) {
        strings.append(readable(text));
    }
    py::dict tables;
    for (const ReplayChunk::Table& table : chunk.tables) {
        py::dict columns;
        for (const ReplayChunk::Column& column : table.columns) {
            columns[py::str(column.name)] = py::bytes(column.octets);
        }
        tables[py::str(table.name)] = columns;
    }
    py::list nodes;
    py::list outcomes;
    py::list counts;
    for (const ReplayChunk::OutcomeCount& of_node : chunk.outcomes) {
        nodes.append(of_node.node);
        outcomes.append(static_cast<int>(of_node.outcome));
        counts.append(of_node.count);
    }
    using namespace py::literals;
    return py::dict("start_ns"_a = chunk.start.ps() / 1000, "end_ns"_a = chunk.end.ps() / 1000,
                    "strings"_a = strings, "columns"_a = tables,
                    "density"_a = py::dict("bin_ns"_a = chunk.density.bin.ps() / 1000,
                                           "frames"_a = chunk.density.frames, "lost"_a = chunk.density.lost),
                    "outcomes"_a = py::dict("node"_a = nodes, "outcome"_a = outcomes, "count"_a = counts));
}

py::list take(ReplayRecorder& recorder) {
    py::list chunks;
    for (const ReplayChunk& chunk : recorder.take()) {
        chunks.append(as_python(chunk));
    }
    return chunks;
}

}  // namespace

void bind_replay(py::module_& module) {
    py::class_<ReplayRecorder>(module, "ReplayRecorder")
        .def("sample_path", &ReplayRecorder::sample_path, py::arg("node"))
        .def("variable_set", &ReplayRecorder::variable_set, py::arg("node"), py::arg("name"),
             py::arg("value"))
        .def(
            "event",
            [](ReplayRecorder& recorder, NodeId node, int kind, const std::string& text) {
                recorder.event(node, static_cast<ReplayRecorder::EventKind>(kind), text);
            },
            py::arg("node"), py::arg("kind"), py::arg("text"))
        .def("close_chunk", &ReplayRecorder::close_chunk)
        .def("finish", &ReplayRecorder::finish)
        .def("take", &take);
}

}  // namespace proxy_protocol
