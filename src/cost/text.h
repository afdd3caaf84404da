#pragma once
// Numbers and names as reports print them.

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace cost {

/// Three significant digits, no exponent for everyday sizes: "0.0123", "4.56", "789", "12300".
std::string number(double value);
/// As few digits as it takes: "0.05", "20".
std::string short_number(double value);
/// The pieces one after the other.
std::string joined(std::initializer_list<std::string_view> pieces);
/// "1.2 MB".
std::string bytes(std::uint64_t count);
/// & < > " as entities.
std::string escaped(std::string_view text);

}  // namespace cost
