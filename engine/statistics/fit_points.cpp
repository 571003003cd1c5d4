// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/fit_points.hpp"

#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

UsedPoints used_points(const FitPoints& points, std::size_t parameters, double confidence) {
  if (!(confidence > 0 && confidence < 1))
    throw Error(ErrorCode::bad_value, "`confidence` is " + format_short(confidence),
                "give one above 0 and below 1, such as 0.95");
  const bool weighted = !points.weights.empty();
  if (points.x.size() != points.y.size() || (weighted && points.weights.size() != points.x.size()))
    throw Error(ErrorCode::bad_value,
                "the points of a fit have " + std::to_string(points.x.size()) + " x, " +
                    std::to_string(points.y.size()) + " y" +
                    (weighted ? " and " + std::to_string(points.weights.size()) + " weights" : ""),
                "give as many of one as of the other");
  UsedPoints used;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    const double weight = weighted ? points.weights[k] : 1;
    if (!std::isfinite(points.x[k]) || !std::isfinite(points.y[k]) || !std::isfinite(weight))
      throw Error(ErrorCode::bad_value, "point " + std::to_string(k + 1) + " of the fit is not finite");
    if (weight < 0)
      throw Error(ErrorCode::bad_value,
                  "the weight of point " + std::to_string(k + 1) + " is " + format_short(weight),
                  "weights are not negative; a usual one is 1/u² with u the uncertainty of y");
    if (weight == 0) continue;
    used.x.push_back(points.x[k]);
    used.y.push_back(points.y[k]);
    used.weights.push_back(weight);
  }
  if (used.x.size() < parameters + 1)
    throw Error(ErrorCode::bad_value,
                std::to_string(parameters) + (parameters == 1 ? " parameter" : " parameters") +
                    " cannot be fitted with intervals to " + std::to_string(used.x.size()) +
                    (used.x.size() == 1 ? " point" : " points"),
                "give at least " + std::to_string(parameters + 1) +
                    " rows with numbers in all columns and a weight above 0");
  return used;
}

}  // namespace asperity
