// The declarations of all fields as JSON, from which `make schema` writes the keys of .ini files and a type stub.
#pragma once

#include <string>

namespace netsim {

// A list with one object for each field.
std::string schema_json();

}  // namespace netsim
