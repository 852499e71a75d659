// Conversion between Python str and UTF-8.
//
// Any Python string may be sent, also one with lone surrogates, which plain UTF-8 cannot hold
// ("surrogatepass").
#pragma once

#include <string>

#include <pybind11/pybind11.h>

namespace proxy_protocol {

// `text` is a str.
std::string utf8_from_python(pybind11::handle text);

// A new reference to a str.
pybind11::object python_from_utf8(const std::string& text);

}  // namespace proxy_protocol
