// Conversion between Python str and UTF-8.
//
// Any Python string can be sent, even one with lone surrogates, which strict UTF-8 cannot encode
// (error handler "surrogatepass").
#pragma once

#include <string>

#include <pybind11/pybind11.h>

namespace proxy_protocol {

// `text` is a str.
std::string utf8_from_python(pybind11::handle text);

// A new reference to a str.
pybind11::object python_from_utf8(const std::string& text);

}  // namespace proxy_protocol
