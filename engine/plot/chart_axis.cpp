// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/chart_axis.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

std::string superscript(int power) {
  constexpr std::array<std::string_view, 10> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = power < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(power))) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

struct Scale {
  std::string unit;  // as printed, "": none
  double factor = 1;
};

Scale scale_for(std::string_view unit, double largest, bool logarithmic) {
  if (unit.empty()) {
    // Numbers with many zeros move a power of ten into the label.
    if (!logarithmic && largest > 0 && std::isfinite(largest) && (largest < 1e-3 || largest >= 1e5)) {
      const int power = 3 * static_cast<int>(std::floor(elementary::log10(largest) / 3));
      if (power < -300) return {};
      return {"10" + superscript(power), elementary::pow(10.0, power)};
    }
    return {};
  }
  try {
    const Quantity one = parse_unit(unit);
    // Shares stay plain numbers; only "%" is shown.
    if (one.dimension == dimension::number)
      return one.value == 1 ? scale_for("", largest, logarithmic) : Scale{printed_unit(unit), 1};
    const DisplayUnit display = display_unit(largest * one.value, one.dimension);
    const double factor = display.factor / one.value;
    if (std::isfinite(factor) && factor > 0) return {printed_unit(display.name), factor};
  } catch (const Error&) {
    // Not a physical unit ("cells", "trials"): shown as given.
  }
  return {printed_unit(unit), 1};
}

std::string with_minus_sign(std::string label) {
  if (label.starts_with('-')) label.replace(0, 1, "−");
  return label;
}

std::string tic_label(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-elementary::log10(step) - 1e-9)));
  if (decimals > 6 || std::abs(value) >= 1e7) {
    const double ratio = std::abs(value) < step ? 1 : std::abs(value) / step;
    return with_minus_sign(format_short(std::abs(value) < step / 2 ? 0.0 : value,
                                        static_cast<int>(elementary::log10(ratio) + 1e-6) + 2));
  }
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value == 0 ? 0.0 : value);
  std::string label = text.data();
  const bool zero = label.find_first_of("123456789") == std::string::npos;
  return zero ? label.substr(label[0] == '-') : with_minus_sign(label);
}

std::vector<Tic> linear_tics(double low, double high, int wanted, bool whole = false) {
  double step = round_below((high - low) / wanted);
  if (whole) step = std::max(step, 1.0);
  // Too many tics: next round step.
  if ((high - low) / step > 1.5 * wanted) step = round_below(2.6 * step);
  std::vector<Tic> tics;
  const double first = std::ceil(low / step - 1e-9);
  for (int k = 0; k < 40; ++k) {
    const double at = (first + k) * step;
    if (at > high + 1e-9 * step) break;
    tics.push_back({at, tic_label(at, step)});
  }
  return tics;
}

std::string power_label(int mantissa, int power, bool plain) {
  if (power == 0 || (plain && power >= -3 && power <= 4))
    return format_short(mantissa * elementary::pow(10.0, power), 6);
  return (mantissa == 1 ? "" : std::to_string(mantissa) + "·") + std::string("10") + superscript(power);
}

std::vector<Tic> logarithmic_tics(double low, double high) {
  const double decades = elementary::log10(high) - elementary::log10(low);
  const int first = static_cast<int>(std::floor(elementary::log10(low))),
            last = static_cast<int>(std::ceil(elementary::log10(high)));
  // Too short for tics at 1, 2, 5.
  if (decades < 0.67) return linear_tics(low, high, 6);
  const int every = std::max(1, static_cast<int>(std::ceil(decades / 8)));
  std::vector<Tic> tics;
  for (int power = first; power <= last; ++power) {
    const double decade = elementary::pow(10.0, power);
    for (int mantissa = 1; mantissa <= 9; ++mantissa) {
      const double at = mantissa * decade;
      if (at < low * (1 - 1e-12) || at > high * (1 + 1e-12) || !std::isfinite(at)) continue;
      const bool full = mantissa == 1 && power % every == 0;
      const bool part = decades < 2.2 && (mantissa == 2 || mantissa == 5);
      if (mantissa > 1 && every > 1) continue;
      tics.push_back({at, full || part ? power_label(mantissa, power, decades < 6) : std::string()});
    }
  }
  return tics;
}

AxisLayout names_layout(const ChartAxis& axis) {
  constexpr std::size_t longest = 24;
  constexpr double character = 11.8, between = 14;  // pixels
  AxisLayout layout;
  layout.label = axis.label;
  layout.low = -0.5;
  layout.high = static_cast<double>(axis.names.size()) - 0.5;
  const double room = axis.names_room / static_cast<double>(axis.names.size());
  for (std::size_t k = 0; k < axis.names.size(); ++k) {
    const std::string name = shortened(axis.names[k], longest);
    layout.slanted |= character * static_cast<double>(characters_of(name)) + between > room;
    layout.tics.push_back({static_cast<double>(k), name});
  }
  return layout;
}

}  // namespace

double round_below(double value) {
  const double decade = elementary::pow(10.0, std::floor(elementary::log10(value)));
  const double share = value / decade;
  constexpr double slack = 1e-9;
  const double mantissa = share >= 5 - slack ? 5 : share >= 2 - slack ? 2 : 1;
  return (share >= 10 - slack ? 10 : mantissa) * decade;
}

std::string printed_unit(std::string_view unit) {
  std::string text;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const bool begins = k == 0 || !std::isalpha(static_cast<unsigned char>(unit[k - 1]));
    const bool more = k + 1 < unit.size() && std::isalpha(static_cast<unsigned char>(unit[k + 1]));
    if (unit[k] == 'u' && begins && more) {
      text += "µ";
    } else if (unit[k] == '*') {
      text += "·";
    } else if (unit[k] == '^') {
      std::size_t end = k + 1;
      while (end < unit.size() && (std::isdigit(static_cast<unsigned char>(unit[end])) || unit[end] == '-'))
        ++end;
      int power = 0;
      if (std::sscanf(std::string(unit.substr(k + 1, end - k - 1)).c_str(), "%3d", &power) != 1) {
        text += unit[k];
        continue;
      }
      text += superscript(power);
      k = end - 1;
    } else {
      text += unit[k];
    }
  }
  return text == "deg" ? "°" : text;
}

std::string printed_quantity(double value, std::string_view unit, int digits) {
  const Scale scale = scale_for(unit, std::abs(value), true);
  const std::string number = format_short(value / scale.factor, digits);
  return scale.unit.empty() ? number : number + " " + scale.unit;
}

std::string shortened(std::string_view text, std::size_t longest) {
  if (characters_of(text) <= longest) return std::string(text);
  std::size_t end = 0;
  for (std::size_t count = 0; count < longest; ++count) do {
      ++end;
    } while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80);
  return std::string(text.substr(0, end)) + "…";
}

AxisLayout lay_out(const ChartAxis& axis, std::span<const double> values, double margin) {
  if (!axis.names.empty()) return names_layout(axis);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto take = [&](double value) {
    if (!std::isfinite(value) || (axis.logarithmic && value <= 0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  if (axis.range) {
    take(axis.range->min);
    take(axis.range->max);
  } else {
    for (const double value : values) take(value);
  }
  if (low > high) {
    low = axis.logarithmic ? 1 : 0;
    high = axis.logarithmic ? 10 : 1;
  }
  // Avoids overflow in the sums below.
  constexpr double largest = 1e300, smallest = 1e-300;
  const double least = axis.logarithmic ? smallest : -largest;
  low = std::clamp(low, least, largest);
  high = std::clamp(high, least, largest);
  AxisLayout layout;
  // On a logarithmic axis the middle decade should read best.
  const double usual =
      axis.logarithmic ? std::sqrt(low) * std::sqrt(high) : std::max(std::abs(low), std::abs(high));
  const double magnitude = axis.prefix_for.value_or(usual);
  const Scale scale = scale_for(axis.unit, magnitude, axis.logarithmic);
  layout.unit = scale.unit;
  layout.factor = scale.factor;
  layout.label = axis.label;
  if (!scale.unit.empty()) layout.label += (layout.label.empty() ? "(" : " (") + scale.unit + ")";
  low /= scale.factor;
  high /= scale.factor;
  if (axis.logarithmic) {
    // A single value gets a factor of 2 on each side.
    if (high < low * (1 + 1e-9)) margin = 0, low /= 2, high *= 2;
    const double stretch =
        axis.range ? 1 : elementary::exp(margin * (elementary::log(high) - elementary::log(low)));
    layout.low = std::max(low / stretch, 1e-305);
    layout.high = std::min(high * stretch, 1e305);
    layout.tics = logarithmic_tics(layout.low, layout.high);
  } else {
    const double size = std::max(std::abs(low), std::abs(high));
    if (high - low <= 1e-12 * size || high - low < smallest) {
      const double half = size > 1e-290 ? 0.1 * size : 1;
      low -= half;
      high += half;
    }
    const double room = axis.range ? 0 : margin * (high - low);
    layout.low = low - room;
    layout.high = high + room;
    const bool counts = high - low >= 2 && scale.factor == 1 &&
                        std::all_of(values.begin(), values.end(),
                                    [](double v) { return !std::isfinite(v) || v == std::floor(v); });
    layout.tics = linear_tics(layout.low, layout.high, axis.tics, counts);
  }
  return layout;
}

}  // namespace asperity
