// Prints the declarations of all fields. Compiled from cpp/netsim/config alone, for write_schema.py.
#include <iostream>

#include "netsim/config/schema_json.hpp"

int main() {
    std::cout << netsim::schema_json();
}
