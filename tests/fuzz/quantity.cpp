// SPDX-License-Identifier: GPL-3.0-or-later
// A parsed quantity or unit is finite, has a text that reads back, and is refused as another dimension.
#include "engine/core/quantity.hpp"

#include <cmath>
#include <iterator>

#include "engine/core/text.hpp"
#include "tests/fuzz/target.hpp"

static void fuzz_quantity(const std::uint8_t* data, std::size_t size) {
  using namespace asperity;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::refused(0, [&] {
    const Quantity unit = parse_unit(text);
    fuzz::require(std::isfinite(unit.value) && unit.value > 0, "a unit is a finite amount above zero");
  });
  fuzz::refused(0, [&] {
    const Quantity found = parse_quantity(text);
    fuzz::require(std::isfinite(found.value), "a quantity is finite");
    fuzz::require(parse_quantity_as(text, found.dimension) == found.value, "the same either way");
    fuzz::require(fuzz::is_plain_text(describe(found.dimension)), "a dimension has a name");
    // SI text restores every bit, readable text the shown digits.
    const std::string exact = format_exact(found.value) + " " + si_unit(found.dimension);
    fuzz::require(parse_quantity_as(exact, found.dimension) == found.value, "reads back: " + exact);
    const std::string shown = format_quantity(found.value, found.dimension, 6);
    const double rounded = parse_quantity_as(shown, found.dimension);
    fuzz::require(std::abs(rounded - found.value) <= 1e-5 * std::abs(found.value) + 1e-300,
                  "shown: " + shown);
  });
  constexpr Dimension dimensions[] = {dimension::number, dimension::length, dimension::pressure,
                                      dimension::angle};
  fuzz::refused(0, [&] { (void)parse_quantity_as(text, dimensions[size % std::size(dimensions)]); });
}

static const asperity::fuzz::Target quantity_target{"quantity", fuzz_quantity};
