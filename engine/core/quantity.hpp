// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities as text: "250 um", "80 MPa/um". A dimension holds exponents of metre, kilogram, second and
// radian. Values are SI.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

struct Dimension {
  std::int8_t length = 0, mass = 0, time = 0, angle = 0;
  bool operator==(const Dimension&) const = default;
};

// Of a quotient.
constexpr Dimension operator/(Dimension a, Dimension b) {
  const auto less = [](std::int8_t x, std::int8_t y) { return static_cast<std::int8_t>(x - y); };
  return {less(a.length, b.length), less(a.mass, b.mass), less(a.time, b.time), less(a.angle, b.angle)};
}

namespace dimension {
inline constexpr Dimension number{};
inline constexpr Dimension length{1, 0, 0, 0};
inline constexpr Dimension area{2, 0, 0, 0};
inline constexpr Dimension volume{3, 0, 0, 0};
inline constexpr Dimension mass{0, 1, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension angle{0, 0, 0, 1};
inline constexpr Dimension force{1, 1, -2, 0};
inline constexpr Dimension pressure{-1, 1, -2, 0};
inline constexpr Dimension stiffness{-2, 1, -2, 0};  // Pa/m, of a surface
inline constexpr Dimension energy{2, 1, -2, 0};
inline constexpr Dimension energy_per_area{0, 1, -2, 0};
inline constexpr Dimension density{-3, 1, 0, 0};
inline constexpr Dimension speed{1, 0, -1, 0};
inline constexpr Dimension acceleration{1, 0, -2, 0};
inline constexpr Dimension frequency{0, 0, -1, 0};
}  // namespace dimension

// "a length"; "250 um".
std::string describe(Dimension dimension);
std::string example_quantity(Dimension dimension);
// "m", "Pa", "J/m^2"; "" for a plain number.
std::string si_unit(Dimension dimension);

// Smallest first.
std::vector<std::string> usual_units(Dimension dimension);

struct Quantity {
  double value = 0;  // SI
  Dimension dimension;
};

// "<number> [unit]": products such as "MPa/um", "kg m^-3", "um²", "N*m"; "/" divides by the next unit only.
// No unit means a plain number; "inf" and "nan" are refused. Decimal units round once: "250 um" is the
// double 250e-6. Throws Error{bad_unit}.
Quantity parse_quantity(std::string_view text);

// As in a table header "time [s]".
Quantity parse_unit(std::string_view text);

// In SI. Throws Error{bad_unit}.
double parse_quantity_as(std::string_view text, Dimension wanted);

// ("10 MPa", "MPa") -> 10, ("5 %", "") -> 0.05. Throws Error{bad_unit} for different dimensions, and for a
// text without unit unless `unit` is "".
double parse_quantity_in(std::string_view text, std::string_view unit);

// 2.8e-6 in "um" is 2.8. Decimal units round once; nan and infinity stay. Throw as parse_unit.
double in_unit(double si, std::string_view unit);
double from_unit(double number, std::string_view unit);
// Shortest text that reads back as `si`.
std::string text_in_unit(double si, std::string_view unit);

// 2.5e-4 m -> "250 um", 1.1e9 Pa -> "1.1 GPa".
std::string format_quantity(double value, Dimension dimension, int digits = 4);

// The prefixed unit for axes.
struct DisplayUnit {
  std::string name;   // "um"
  double factor = 1;  // SI value of one unit
};
DisplayUnit display_unit(double largest_magnitude, Dimension dimension);

// By its name in describe(), without article.
std::optional<Dimension> dimension_named(std::string_view name);
std::vector<std::string> dimension_names();

}  // namespace asperity
