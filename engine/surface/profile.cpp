// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/profile.hpp"

#include <cmath>
#include <mutex>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

struct Profile::Data {
  double spacing;
  Array<double> heights;
  std::optional<double> radius;
  mutable std::once_flag digest_once;
  mutable std::string digest;

  Data(double s, Array<double> h, std::optional<double> r) : spacing(s), heights(std::move(h)), radius(r) {}
};

Profile::Profile(double spacing, Array<double> heights, std::optional<double> closed_radius) {
  if (!(std::isfinite(spacing) && spacing > 0))
    throw Error(ErrorCode::bad_value, "the spacing of a profile is " + format_short(spacing) + " m",
                "give a finite length above zero");
  if (heights.empty())
    throw Error(ErrorCode::bad_value, "a profile has no samples", "give at least one height");
  for (std::size_t k = 0; k < heights.size(); ++k)
    if (!std::isfinite(heights[k]))
      throw Error(ErrorCode::bad_value,
                  "the height of sample " + std::to_string(k) + " is " + format_short(heights[k]),
                  "every height must be a finite number of metres");
  data_ = std::make_shared<const Data>(spacing, std::move(heights), closed_radius);
}

double Profile::spacing() const { return data_->spacing; }
std::span<const double> Profile::heights() const { return data_->heights; }
std::optional<double> Profile::closed_radius() const { return data_->radius; }
Range Profile::height_range() const { return range(heights()); }

const std::string& Profile::digest() const {
  std::call_once(data_->digest_once, [&] {
    Digester digester;
    digester.add("profile").add(data_->spacing).add(data_->radius.value_or(0.0)).add(heights());
    data_->digest = digester.hex();
  });
  return data_->digest;
}

}  // namespace asperity
