// SPDX-License-Identifier: GPL-3.0-or-later
// The mean of a sample and how well it is known. The interval of the mean is Student's t by default. For a
// positive quantity whose logarithms are normal there is the log interval of Cox (Zhou & Gao 1997),
// exp(m + s²/2 ± t sqrt(s²/n + s⁴/(2(n-1)))) with m and s² of the logarithms: it holds its level where
// Student's t covers 82 to 91 % of skewed samples. No bootstrap: it covers 62 to 89 % at three to eight
// values.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/statistics/table.hpp"

namespace asperity {

enum class MeanInterval { student, log_normal };

struct SampleMean {
  std::size_t count = 0, left_out = 0;
  double mean = 0;
  std::optional<double> deviation;       // standard deviation, n-1; from two values on
  std::optional<double> standard_error;  // deviation / sqrt(n)
  std::optional<double> skewness;        // m3/m2^(3/2), moments over n; from three values that differ
  std::optional<double> low, high;       // of the mean; from two values on
  double log_centre = 0, log_error = 0;  // of the log interval: of the mean's logarithm
  double confidence = 0.95;
  std::string method;                 // "Student's t, 4 degrees of freedom", with what it assumes
  std::vector<std::string> warnings;  // few values, skewed ones
};

// Values that are not finite are left out and counted. Throws Error{bad_value} when none is left, for a
// confidence that is not between 0 and 1, and for a log interval of values that are not all above 0.
SampleMean sample_mean(std::span<const double> values, MeanInterval interval = MeanInterval::student,
                       double confidence = 0.95);

// Rows that share the cells of the columns `by`.
struct GroupMean {
  std::vector<Cell> by;
  SampleMean of;
};

// The mean of a column for each group, in ascending order (numbers, then booleans, then text); one group
// where `by` is empty. Cells that are empty or not finite are left out and counted; so is a group with no
// number at all, with a count of 0. Throws as sample_mean and number_columns do, naming the group.
std::vector<GroupMean> means_of(const Table& table, const std::string& column,
                                const std::vector<std::string>& by,
                                MeanInterval interval = MeanInterval::student, double confidence = 0.95);

}  // namespace asperity
