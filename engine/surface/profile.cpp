// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/profile.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/digest.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"

namespace asperity {

struct Profile::Data {
  double spacing;
  Array<double> heights;
  std::optional<double> radius;
  std::size_t measured;
  mutable Lazy<std::string> digest;

  Data(double s, Array<double> h, std::optional<double> r, std::size_t m)
      : spacing(s), heights(std::move(h)), radius(r), measured(m) {}
};

Profile::Profile(double spacing, Array<double> heights, std::optional<double> closed_radius)
    : Profile(spacing, std::move(heights), closed_radius, false) {}

Profile Profile::with_holes(double spacing, Array<double> heights, std::optional<double> closed_radius) {
  return Profile(spacing, std::move(heights), closed_radius, true);
}

Profile::Profile(double spacing, Array<double> heights, std::optional<double> closed_radius, bool holes) {
  if (!(std::isfinite(spacing) && spacing > 0))
    refuse("the spacing of a profile is " + format_short(spacing) + " m", "give a finite length above zero");
  if (heights.empty()) refuse("a profile has no samples", "give at least one height");
  std::size_t missing = 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (std::isfinite(heights[k])) continue;
    if (!holes || !std::isnan(heights[k]))
      refuse("the height of sample " + std::to_string(k) + " is " + format_short(heights[k]),
             "every height must be a finite number of metres");
    heights[k] = std::numeric_limits<double>::quiet_NaN();  // one bit pattern
    ++missing;
  }
  if (missing == heights.size()) refuse("no point of the profile was measured", "give at least one height");
  const std::size_t measured = heights.size() - missing;
  data_ = std::make_shared<const Data>(spacing, std::move(heights), closed_radius, measured);
}

double Profile::spacing() const { return data_->spacing; }
std::span<const double> Profile::measured_heights() const { return data_->heights; }
std::size_t Profile::measured() const { return data_->measured; }

std::span<const double> Profile::heights() const {
  const std::span<const double> values = data_->heights;
  if (complete()) return values;
  const auto first = std::find_if(values.begin(), values.end(), [](double z) { return std::isnan(z); });
  refuse(std::to_string(values.size() - measured()) + " of the " + std::to_string(values.size()) +
             " samples of the profile were not measured, the first is sample " +
             std::to_string(first - values.begin()) + ", and this needs every sample",
         "fill them first, `profile:filled{ by=\"interpolate\" }`, or take a part without holes");
}

std::optional<double> Profile::closed_radius() const { return data_->radius; }
Range Profile::height_range() const { return known_range(measured_heights()); }

const std::string& Profile::digest() const {
  return data_->digest.get([&] {
    Digester digester;
    digester.add("profile").add(data_->spacing).add(data_->radius.value_or(0.0)).add(measured_heights());
    return digester.hex();
  });
}

}  // namespace asperity
