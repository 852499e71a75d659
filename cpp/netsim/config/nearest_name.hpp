// "Did you mean …?" for names in configurations.
#pragma once

#include <span>
#include <string_view>

namespace netsim {

// The one of `names` (not empty) with the fewest insertions, deletions and replacements of a letter between
// it and `name`, ignoring the case of ASCII letters; the first of equals. V. Levenshtein, 1966.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> names);

}  // namespace netsim
