#include "proxy_protocol/python_text.hpp"

namespace py = pybind11;

namespace proxy_protocol {

std::string utf8_from_python(py::handle text) {
    Py_ssize_t size = 0;
    if (const char* bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size)) {
        return std::string(bytes, static_cast<std::size_t>(size));
    }
    PyErr_Clear();
    const auto encoded =
        py::reinterpret_steal<py::bytes>(PyUnicode_AsEncodedString(text.ptr(), "utf-8", "surrogatepass"));
    if (!encoded) {
        throw py::error_already_set();
    }
    return std::string(encoded);
}

py::object python_from_utf8(const std::string& text) {
    PyObject* decoded =
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogatepass");
    if (decoded == nullptr) {
        throw py::error_already_set();
    }
    return py::reinterpret_steal<py::object>(decoded);
}

}  // namespace proxy_protocol
