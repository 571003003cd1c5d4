// SPDX-License-Identifier: GPL-3.0-or-later
// The radix sort against the library's, on both sides of its smallest size.
#include "engine/contact/elasticity/box/ascending_sort.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/contact/contacts.hpp"

namespace asperity::ascending_sort_test {
namespace {

TEST(AscendingSort, AgreesWithTheLibrary) {
  for (const std::size_t n : {0UL, 1UL, 2UL, 2047UL, 2048UL, 2049UL, 50000UL})
    for (const double spread : {0.0, 1.0, 300.0}) {
      const Stream stream(n, "sort");
      Array<double> values;
      for (std::size_t k = 0; k < n; ++k)
        values.push_back(stream.uniform(2 * k) * std::pow(10.0, spread * (stream.uniform(2 * k + 1) - 0.5)));
      Array<double> expected = values;
      std::sort(expected.begin(), expected.end());
      sort_ascending(values);
      EXPECT_EQ(values, expected) << n << " " << spread;
    }
}

TEST(AscendingSort, ManyEqualValuesAndExtremes) {
  Array<double> values;
  for (int k = 0; k < 5000; ++k) values.push_back(k % 3);
  values.push_back(std::numeric_limits<double>::max());
  values.push_back(std::numeric_limits<double>::denorm_min());
  Array<double> expected = values;
  std::sort(expected.begin(), expected.end());
  sort_ascending(values);
  EXPECT_EQ(values, expected);
  Array<double> same(5000, 0.7);
  sort_ascending(same);
  EXPECT_EQ(same, Array<double>(5000, 0.7));
}

}  // namespace
}  // namespace asperity::ascending_sort_test
