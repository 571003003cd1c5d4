// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities as text, exact to the last bit, and refusals.
#include "engine/core/quantity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::quantity_test {
namespace {

std::string refusal(const std::string& text) {
  return test::refusal([&] { parse_quantity(text); }, ErrorCode::bad_unit);
}

std::string refusal_as(const std::string& text, Dimension wanted) {
  return test::refusal([&] { parse_quantity_as(text, wanted); }, ErrorCode::bad_unit);
}

double length(const std::string& text) { return parse_quantity_as(text, dimension::length); }

TEST(Quantity, DecimalUnitsAreRoundedOnce) {
  EXPECT_EQ(length("250 um"), 250e-6);
  EXPECT_EQ(length("0.1 um"), 0.1e-6);
  EXPECT_EQ(length("0.3 nm"), 0.3e-9);
  EXPECT_EQ(length("1.1 mm"), 1.1e-3);
  EXPECT_EQ(length("7 pm"), 7e-12);
  EXPECT_EQ(length("1e-3 km"), 1.0);
  EXPECT_EQ(parse_quantity_as("152.78 MPa", dimension::pressure), 152.78e6);
  EXPECT_EQ(parse_quantity_as("4.3 g", dimension::mass), 4.3e-3);
  EXPECT_EQ(parse_quantity_as("80 MPa/um", dimension::stiffness), 80e12);
  EXPECT_EQ(parse_quantity_as("0.0000001 GPa", dimension::pressure), 100.0);
}

TEST(Quantity, IsCountedInAnotherUnitOfItsKind) {
  EXPECT_EQ(parse_quantity_in("10 MPa", "MPa"), 10);
  EXPECT_EQ(parse_quantity_in("0.1 um", "um"), 0.1);
  EXPECT_EQ(parse_quantity_in("0.3 GPa", "MPa"), 300);
  EXPECT_EQ(parse_quantity_in("7 deg", "deg"), 7);
  EXPECT_EQ(parse_quantity_in("90 min", "h"), 1.5);
  EXPECT_EQ(parse_quantity_in("5 %", ""), 0.05);
  EXPECT_EQ(parse_quantity_in("5 %", "-"), 0.05);
  EXPECT_EQ(parse_quantity_in("0.05", ""), 0.05);
  EXPECT_EQ(parse_quantity_in("0.05 1", "%"), 5);
  EXPECT_THROW(parse_quantity_in("5", "%"), Error);
  EXPECT_THROW(parse_quantity_in("10 N", "MPa"), Error);
  EXPECT_THROW(parse_quantity_in("10 MPa", ""), Error);
  EXPECT_THROW(parse_quantity_in("10", "deg"), Error);
}

TEST(Quantity, EveryWholeNumberOfMicrometresIsTheNearestDouble) {
  for (int n = 1; n <= 5000; ++n) {
    const std::string digits = std::to_string(n);
    ASSERT_EQ(length(digits + " um"), std::stod(digits + "e-6")) << n;
  }
}

TEST(Quantity, OtherUnits) {
  EXPECT_EQ(parse_quantity_as("10 min", dimension::time), 600.0);
  EXPECT_EQ(parse_quantity_as("1.5 h", dimension::time), 5400.0);
  EXPECT_EQ(parse_quantity_as("1 in", dimension::length), 0.0254);
  EXPECT_EQ(parse_quantity_as("180 deg", dimension::angle), std::numbers::pi);
  EXPECT_EQ(parse_quantity_as("90°", dimension::angle), std::numbers::pi / 2);
  EXPECT_EQ(parse_quantity_as("0.25 turn", dimension::angle), std::numbers::pi / 2);
  EXPECT_EQ(parse_quantity_as("2 mrad", dimension::angle), 2e-3);
  EXPECT_EQ(parse_quantity_as("1 bar", dimension::pressure), 1e5);
  EXPECT_EQ(parse_quantity_as("2 t", dimension::mass), 2000.0);
  EXPECT_EQ(parse_quantity_as("200 Hz", dimension::frequency), 200.0);
  EXPECT_EQ(parse_quantity_as("20 %", dimension::number), 0.2);
  EXPECT_EQ(parse_quantity_as("0.5", dimension::number), 0.5);
  EXPECT_EQ(parse_quantity_as("0.5 1", dimension::number), 0.5);
  EXPECT_EQ(parse_quantity_as("3 kN mm", dimension::energy), 3.0);
  EXPECT_EQ(parse_quantity_as("36 km/h", dimension::speed), 10.0);
}

// lb = 0.45359237 kg, in = 25.4 mm, standard gravity 9.80665 m/s².
TEST(Quantity, UnitsOfScalesAndGaugesOfPresses) {
  const double pound = 0.45359237 * 9.80665, square_inch = 0.0254 * 0.0254;
  const auto force = [](const char* text) { return parse_quantity_as(text, dimension::force); };
  const auto pressure = [](const char* text) { return parse_quantity_as(text, dimension::pressure); };
  EXPECT_DOUBLE_EQ(force("1 lbf"), pound);
  EXPECT_DOUBLE_EQ(force("2 kip"), 2000 * pound);
  EXPECT_EQ(force("1 kgf"), 9.80665);
  EXPECT_EQ(force("1 tf"), 9806.65);
  EXPECT_EQ(force("1 daN"), 10.0);
  EXPECT_DOUBLE_EQ(pressure("1 psi"), pound / square_inch);
  EXPECT_DOUBLE_EQ(pressure("1 ksi"), 1000 * pound / square_inch);
  EXPECT_EQ(pressure("1 atm"), 101325.0);
  EXPECT_DOUBLE_EQ(parse_quantity_as("0.5 rev", dimension::angle), std::numbers::pi);
}

TEST(Quantity, OldAndAngloAmericanUnitsByTheirDefinitions) {
  const auto force = [](const char* text) { return parse_quantity_as(text, dimension::force); };
  const auto pressure = [](const char* text) { return parse_quantity_as(text, dimension::pressure); };
  EXPECT_EQ(force("1 kp"), 9.80665);
  EXPECT_EQ(force("1 kp"), force("1 kgf"));
  EXPECT_EQ(force("1 lbf"), 4.4482216152605);
  EXPECT_EQ(force("1 kip"), 4448.2216152605);
  // 4.4482216152605 N over 645.16 mm².
  EXPECT_DOUBLE_EQ(pressure("1 psi"), 6894.757293168361336722);
  EXPECT_DOUBLE_EQ(pressure("1 ksi"), 6894757.293168361336722);
  EXPECT_EQ(pressure("1 HV"), 9806650.0);
  EXPECT_EQ(pressure("250 HV"), 2451662500.0);
  EXPECT_DOUBLE_EQ(pressure("1 kgf/mm^2"), pressure("1 HV"));
  EXPECT_DOUBLE_EQ(pressure("1 kp/cm^2"), 98066.5);
  EXPECT_EQ(length("1 inch"), 0.0254);
  EXPECT_EQ(length("1 mil"), 25.4e-6);
  EXPECT_EQ(length("1 thou"), 25.4e-6);
  EXPECT_EQ(length("1 uin"), 25.4e-9);
  EXPECT_EQ(length("32 µin"), length("32 uin"));
  EXPECT_EQ(length("1 ft"), 0.3048);
  EXPECT_EQ(parse_quantity_as("1 lb", dimension::mass), 0.45359237);
}

TEST(Quantity, DaysMicronsAndHardModuli) {
  const auto time = [](const char* text) { return parse_quantity_as(text, dimension::time); };
  EXPECT_EQ(time("1 day"), 86400.0);
  EXPECT_EQ(time("2.5 d"), 216000.0);
  EXPECT_EQ(time("1 week"), 604800.0);
  EXPECT_EQ(length("3 micron"), 3e-6);
  EXPECT_EQ(length("2 angstrom"), 2e-10);
  EXPECT_EQ(length("2 \u00C5"), 2e-10);
  EXPECT_EQ(parse_quantity_as("1.05 TPa", dimension::pressure), 1.05e12);
}

// Units of their own: no prefixes k, m, a; no units d, h.
TEST(Quantity, NamesThatLookLikePrefixesAreUnitsOfTheirOwn) {
  EXPECT_EQ(parse_unit("kip").dimension, dimension::force);
  EXPECT_EQ(parse_unit("ksi").dimension, dimension::pressure);
  EXPECT_EQ(parse_unit("mil").dimension, dimension::length);
  EXPECT_EQ(parse_unit("atm").dimension, dimension::pressure);
  EXPECT_EQ(parse_unit("ft").dimension, dimension::length);
  EXPECT_EQ(parse_unit("min").dimension, dimension::time);
  EXPECT_EQ(parse_unit("uin").dimension, dimension::length);
  EXPECT_EQ(refusal("1 mpsi").substr(0, 29), "\"1 mpsi\": unknown unit `mpsi`");
  EXPECT_EQ(refusal("1 kin").substr(0, 27), "\"1 kin\": unknown unit `kin`");
}

// ISO 6507: the test load follows the symbol.
TEST(Quantity, VickersHardnessIsWrittenWithItsTestLoad) {
  for (const char* text : {"640 HV", "640 HV10", "640 HV0.3", "640HV30"})
    EXPECT_EQ(parse_quantity_as(text, dimension::pressure), 640 * 9806650.0) << text;
  EXPECT_EQ(parse_quantity("2 HV^2").dimension, (Dimension{-2, 2, -4, 0}));
  for (const char* scale : {"HB", "HBW", "HK"})
    EXPECT_EQ(refusal(std::string("100 ") + scale),
              "\"100 " + std::string(scale) + "\": `" + scale +
                  "` is a scale of hardness, and hardness is a pressure; write " + scale +
                  " x 9.807 MPa: 100 " + scale + " is \"980.7 MPa\"");
}

TEST(Quantity, MicroSignsAndSpacesOfTextEditors) {
  EXPECT_EQ(length("250 \u00B5m"), 250e-6);
  EXPECT_EQ(length("250 \u03BCm"), 250e-6);
  EXPECT_EQ(length("250\u00A0\u00B5m"), 250e-6);
  EXPECT_EQ(length("250\u202Fum"), 250e-6);
  EXPECT_EQ(length("250um"), 250e-6);
  EXPECT_EQ(length("  +2.5e2   um "), 250e-6);
  EXPECT_EQ(length("-.5 mm"), -0.5e-3);
  EXPECT_EQ(length("5.mm"), 5e-3);
}

TEST(Quantity, ProductsQuotientsAndPowers) {
  for (const std::string unit :
       {"kg/m^3", "kg m^-3", "kg*m**-3", "kg·m⁻³", "kg/m³", "kg/m3", "kg m-3", "kg / m / m^2"})
    EXPECT_EQ(parse_quantity_as("2830 " + unit, dimension::density), 2830.0) << unit;
  EXPECT_EQ(parse_quantity_as("2 um²", dimension::area), 2e-12);
  EXPECT_EQ(parse_quantity_as("2 um^2", dimension::area), 2e-12);
  EXPECT_EQ(parse_quantity_as("3 1/m", {-1, 0, 0, 0}), 3.0);
  EXPECT_EQ(parse_quantity_as("6 turn/min", {0, 0, -1, 1}), 6 * (2 * std::numbers::pi) / 60);
  EXPECT_EQ(parse_quantity_as("50 mJ/m^2", dimension::energy_per_area), 0.05);
  EXPECT_EQ(parse_quantity_as("5 N/m", dimension::energy_per_area), 5.0);
}

TEST(Quantity, UnitAlone) {
  EXPECT_EQ(parse_unit("um").value, 1e-6);
  EXPECT_EQ(parse_unit("um").dimension, dimension::length);
  EXPECT_EQ(parse_unit("").dimension, dimension::number);
  EXPECT_EQ(parse_unit("-").value, 1.0);
  EXPECT_EQ(parse_unit("1").value, 1.0);
  EXPECT_EQ(parse_unit("%").value, 0.01);
}

TEST(Quantity, UnknownUnitNamesTheNearest) {
  EXPECT_EQ(refusal("250 umm"), "\"250 umm\": unknown unit `umm` (did you mean `um`?)");
  EXPECT_EQ(refusal("1 Mpa"), "\"1 Mpa\": unknown unit `Mpa` (did you mean `MPa`?)");
  EXPECT_EQ(refusal("1 mPa"), "\"1 mPa\": unknown unit `mPa` (did you mean `MPa`?)");
  EXPECT_EQ(refusal("3 degs"), "\"3 degs\": unknown unit `degs` (did you mean `deg`?)");
  EXPECT_EQ(
      refusal("3 parsec"),
      "\"3 parsec\": unknown unit `parsec`; units are products of m, g, s, min, N, Pa, bar, J, rad, deg, Hz, "
      "% with prefixes, such as um, MPa/um, kg m^-3");
}

TEST(Quantity, WhatIsNotANumber) {
  const std::string none = ": no number at its start; write a number and a unit, such as \"250 um\"";
  for (const std::string text : {"", "  ", "um", "inf um", "nan", "-", ".", "e5", "--3 m", "+ 3 m", "∞ m"})
    EXPECT_EQ(refusal(text), "\"" + text + "\"" + none) << text;
  EXPECT_EQ(refusal("0x10 m").substr(0, 26), "\"0x10 m\": unknown unit `x`");
  EXPECT_EQ(refusal("1,5 mm"),
            "\"1,5 mm\": a comma inside a number; write the decimal sign as a point, such as \"1.5 mm\"");
  for (const char* text : {"1,250.5 um", "1'250.5 um"})
    EXPECT_TRUE(refusal(text).ends_with("write \"1250.5 um\""));
  EXPECT_TRUE(refusal("1.250,5 um").ends_with("such as \"1.5 mm\""));
  EXPECT_TRUE(refusal("60 rpm").ends_with("60 rpm is \"1 Hz\" or \"60 rev/min\""));
  EXPECT_TRUE(refusal("20 \u00B0C").ends_with("write a plain number in K: 293.15 for 20 \u00B0C"));
  EXPECT_EQ(refusal("1 2 m"), "\"1 2 m\": cannot read a unit from \"2 m\"");
  EXPECT_EQ(refusal("1.2.3 m"), "\"1.2.3 m\": cannot read a unit from \".3 m\"");
}

TEST(Quantity, MalformedUnits) {
  EXPECT_EQ(refusal("1 N/"), "\"1 N/\": a unit is missing at the end; complete it, or drop the last sign");
  EXPECT_EQ(refusal("1 N*"), "\"1 N*\": a unit is missing at the end; complete it, or drop the last sign");
  EXPECT_EQ(refusal("1 /m"), "\"1 /m\": cannot read a unit from \"/m\"");
  EXPECT_EQ(refusal("1 N//m"), "\"1 N//m\": cannot read a unit from \"/m\"");
  EXPECT_EQ(refusal("1 m^"),
            "\"1 m^\": the power of a unit is no whole number from -9 to 9; write it such as \"kg m^-3\"");
  EXPECT_EQ(refusal("1 m^2.5"),
            "\"1 m^2.5\": the power of a unit is no whole number from -9 to 9; write it such as \"kg m^-3\"");
  EXPECT_EQ(refusal("1 m^10"),
            "\"1 m^10\": the power of a unit is no whole number from -9 to 9; write it such as \"kg m^-3\"");
  EXPECT_EQ(refusal("1 m⁻"),
            "\"1 m⁻\": the power of a unit is no whole number from -9 to 9; write it such as \"kg m^-3\"");
  EXPECT_EQ(
      refusal("1 J/(m s)"),
      "\"1 J/(m s)\": brackets in a unit; write every divisor after its own stroke, such as \"J/m^2/s\"");
}

TEST(Quantity, RangeOfNumbers) {
  EXPECT_EQ(refusal("1e309 m"), "\"1e309 m\": the value is outside the range of numbers; check its exponent");
  EXPECT_EQ(refusal("1e300 km^9"),
            "\"1e300 km^9\": the value is outside the range of numbers; check its exponent");
  EXPECT_EQ(refusal("1e-400 m"),
            "\"1e-400 m\": the value is outside the range of numbers; check its exponent");
  EXPECT_EQ(refusal("1e99999999999999999999 m"),
            "\"1e99999999999999999999 m\": the value is outside the range of numbers; check its exponent");
  EXPECT_EQ(length("1e312 pm"), 1e300);
  EXPECT_EQ(length("1e0000000000000000003 m"), 1000.0);
  EXPECT_EQ(length("0e999 m"), 0.0);
}

TEST(Quantity, HugeTextIsBounded) {
  std::string units = "1 m";
  for (int k = 0; k < 5000; ++k) units += " m";
  EXPECT_EQ(refusal(units),
            "\"1 m m m m m m m m m m m m m m m m m m m ...\": the powers of its units are too high");
  EXPECT_LT(refusal("1 " + std::string(1000000, 'q')).size(), 300u);
  EXPECT_LT(refusal(std::string(1000000, '\xFF')).size(), 300u);
  EXPECT_EQ(length(std::string(100000, '0') + "1 m"), 1.0);
  EXPECT_EQ(length("1e" + std::string(100000, '0') + " m"), 1.0);
}

TEST(Quantity, MessageHoldsOnlyWholeCharacters) {
  EXPECT_EQ(refusal("1 \xFF\n").substr(0, 8), "\"1 ??\": ");
  const std::string text = "1 " + std::string(37, 'q') + "µµ";  // the first µ would end at byte 41
  EXPECT_EQ(refusal(text).substr(0, 45), "\"1 " + std::string(37, 'q') + "...\":");
}

TEST(Quantity, WrongDimensionNamesBoth) {
  EXPECT_EQ(refusal_as("250 MPa", dimension::length),
            "\"250 MPa\": a pressure where a length is wanted; write it such as \"250 um\"");
  EXPECT_EQ(refusal_as("250", dimension::length),
            "\"250\": no unit where a length is wanted; write a length such as \"250 um\", or a number "
            "without quotes "
            "in m");
  EXPECT_EQ(refusal_as("1", dimension::angle),
            "\"1\": no unit where an angle is wanted; write an angle such as \"37 deg\", or a number without "
            "quotes "
            "in rad");
  EXPECT_EQ(refusal_as("37 deg", dimension::number),
            "\"37 deg\": an angle where a plain number is wanted; write a plain number such as \"0.5\"");
  EXPECT_EQ(refusal_as("3 J/s", dimension::force),
            "\"3 J/s\": a quantity in kg m^2 s^-3 where a force is wanted; write it such as \"5 N\"");
}

const std::vector<Dimension> all_dimensions = {
    dimension::number,          dimension::length,      dimension::area,
    dimension::volume,          dimension::mass,        dimension::time,
    dimension::angle,           dimension::force,       dimension::pressure,
    dimension::energy,          dimension::speed,       dimension::stiffness,
    dimension::energy_per_area, dimension::density,     dimension::acceleration,
    dimension::frequency,       Dimension{2, 1, -3, 0}, Dimension{-1, 0, 0, 0}};

TEST(Quantity, ExamplesAndUnitsAreUnderstood) {
  for (const Dimension d : all_dimensions) {
    EXPECT_EQ(parse_quantity(example_quantity(d)).dimension, d) << describe(d);
    EXPECT_EQ(parse_unit(si_unit(d)).dimension, d) << describe(d);
    EXPECT_EQ(parse_unit(si_unit(d)).value, 1.0) << describe(d);
  }
}

TEST(Quantity, FormattedTextReadsBack) {
  for (const Dimension d : all_dimensions)
    for (const double magnitude : {3.21e-19, 4.5e-8, 9.9996e-4, 0.0, 0.12, 1.0, 77.7, 1.1e9, 4e17}) {
      const std::string text = format_quantity(magnitude, d, 6);
      const Quantity back = parse_quantity(text);
      EXPECT_EQ(back.dimension, d) << text;
      EXPECT_NEAR(back.value, magnitude, 1e-5 * magnitude) << text;
    }
}

TEST(Quantity, FormattedWithReadablePrefix) {
  EXPECT_EQ(format_quantity(2.5e-4, dimension::length), "250 um");
  EXPECT_EQ(format_quantity(-2.5e-4, dimension::length), "-250 um");
  EXPECT_EQ(format_quantity(1.1e9, dimension::pressure), "1.1 GPa");
  EXPECT_EQ(format_quantity(0.9999999e-3, dimension::length), "1 mm");
  EXPECT_EQ(format_quantity(0.999e-3, dimension::length), "999 um");
  EXPECT_EQ(format_quantity(std::numbers::pi / 2, dimension::angle), "90 deg");
  EXPECT_EQ(format_quantity(8e13, dimension::stiffness), "80 MPa/um");
  EXPECT_EQ(format_quantity(0, dimension::pressure), "0 Pa");
  EXPECT_EQ(format_quantity(0, dimension::length), "0 m");
  EXPECT_EQ(format_quantity(0.25, dimension::number), "0.25");
  EXPECT_EQ(format_quantity(std::numeric_limits<double>::infinity(), dimension::pressure), "inf Pa");
  EXPECT_EQ(format_quantity(2, Dimension{2, 1, -3, 0}), "2 kg m^2 s^-3");
}

TEST(Quantity, DisplayUnitOfAnAxis) {
  EXPECT_EQ(display_unit(2.5e-4, dimension::length).name, "um");
  EXPECT_EQ(display_unit(-2.5e-4, dimension::length).factor, 1e-6);
  EXPECT_EQ(display_unit(0, dimension::length).name, "m");
  EXPECT_EQ(display_unit(1e-14, dimension::length).name, "pm");
  EXPECT_EQ(format_quantity(1.108e-21, dimension::length), "1.108e-21 m");
  EXPECT_EQ(display_unit(1e20, dimension::length).name, "km");
  EXPECT_EQ(display_unit(5, dimension::number).name, "");
  EXPECT_EQ(display_unit(5, dimension::number).factor, 1.0);
}

TEST(Quantity, UsualUnitsAreReadAsTheirDimension) {
  for (const Dimension wanted : {dimension::length, dimension::area, dimension::mass, dimension::time,
                                 dimension::angle, dimension::force, dimension::pressure, dimension::speed}) {
    EXPECT_FALSE(usual_units(wanted).empty());
    for (const std::string& unit : usual_units(wanted)) EXPECT_EQ(parse_unit(unit).dimension, wanted) << unit;
  }
  EXPECT_TRUE(usual_units(dimension::number).empty());
}

}  // namespace
}  // namespace asperity::quantity_test
