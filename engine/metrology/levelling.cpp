// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/levelling.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/metrology/blocked_sums.hpp"

namespace asperity {

namespace {

// Polynomials of degree 0, 1, … over n equally spaced nodes, orthonormal there.
class OrthonormalPolynomials {
 public:
  // As many as the nodes can tell apart. Each is x times the one before, made orthogonal to all before
  // it twice over (Gram–Schmidt), which is orthogonal to rounding.
  OrthonormalPolynomials(int n, int degree) : table_(n, std::min(degree, n - 1) + 1) {
    for (int k = 0; k < table_.ny(); ++k) {
      for (int i = 0; i < n; ++i) {
        const double x = n > 1 ? (2.0 * i - (n - 1)) / (n - 1) : 0.0;
        table_(i, k) = k == 0 ? 1 : x * table_(i, k - 1);
      }
      for (int m = 0; m < 2 * k; ++m) subtract(k, m % k, product(k, m % k));
      const double length = std::sqrt(product(k, k));
      for (double& value : table_.row(k)) value /= length;
    }
  }

  int count() const { return table_.ny(); }
  std::span<const double> operator[](int k) const { return table_.row(k); }

 private:
  double product(int k, int m) const {
    double sum = 0;
    for (int i = 0; i < table_.nx(); ++i) sum += table_(i, k) * table_(i, m);
    return sum;
  }
  void subtract(int k, int m, double share) {
    for (int i = 0; i < table_.nx(); ++i) table_(i, k) -= share * table_(i, m);
  }

  Field table_;  // row k holds polynomial k
};

void check_degree(int degree) {
  if (degree < 0 || degree > max_levelling_degree)
    throw Error(ErrorCode::bad_value, "`degree` of levelling is " + std::to_string(degree),
                "give 0 (mean), 1 (plane), 2 (quadratic) … " + std::to_string(max_levelling_degree));
}

// Blocks of rows, each on one thread.
template <class Row>
void for_each_row(int ny, const Row& row) {
  constexpr int rows_per_turn = 16;
  parallel_for((ny + rows_per_turn - 1) / rows_per_turn, [&](std::int64_t turn) {
    const int first = static_cast<int>(turn) * rows_per_turn;
    for (int j = first; j < std::min(ny, first + rows_per_turn); ++j) row(j);
  });
}

// Σ a[i]·b[i] in blocks, for the digits of long lines.
double dot(std::span<const double> a, std::span<const double> b) {
  constexpr std::size_t block = 256;
  double total = 0;
  for (std::size_t first = 0; first < a.size(); first += block) {
    double sum = 0;
    for (std::size_t i = first; i < std::min(a.size(), first + block); ++i) sum += a[i] * b[i];
    total += sum;
  }
  return total;
}

void subtract_fit(Field& z, const OrthonormalPolynomials& along_x, const OrthonormalPolynomials& along_y,
                  int degree) {
  // First what each row holds of each polynomial in x, then of those the polynomials in y.
  Field of_rows(z.ny(), along_x.count());
  for_each_row(z.ny(), [&](int j) {
    for (int a = 0; a < along_x.count(); ++a) of_rows(j, a) = dot(along_x[a], z.row(j));
  });
  Field fit(z.ny(), along_x.count());
  for (int a = 0; a < along_x.count(); ++a)
    for (int b = 0; b < along_y.count() && a + b <= degree; ++b) {
      const double coefficient = dot(along_y[b], of_rows.row(a));
      for (int j = 0; j < z.ny(); ++j) fit(j, a) += coefficient * along_y[b][static_cast<std::size_t>(j)];
    }
  for_each_row(z.ny(), [&](int j) {
    for (int a = 0; a < along_x.count(); ++a) {
      const double share = fit(j, a);
      const std::span<const double> polynomial = along_x[a];
      const std::span<double> row = z.row(j);
      for (std::size_t i = 0; i < row.size(); ++i) row[i] -= share * polynomial[i];
    }
  });
}

// The second pass removes what rounding left of a fit much larger than the roughness.
void level(Field& z, int degree) {
  for (int pass = 0; pass < 2; ++pass) {
    const double mean = exact_mean(z.values(), range(z.values()));
    for_each_row(z.ny(), [&](int j) {
      for (double& value : z.row(j)) value -= mean;
    });
  }
  if (degree == 0) return;
  const OrthonormalPolynomials along_x(z.nx(), degree), along_y(z.ny(), degree);
  for (int pass = 0; pass < 2; ++pass) subtract_fit(z, along_x, along_y, degree);
}

}  // namespace

Surface levelled(const Surface& surface, int degree) {
  check_degree(degree);
  Field z = surface.heights();
  level(z, degree);
  SurfaceTraits traits = surface.traits();
  if (degree > 0) {
    traits.periodic = false;
    traits.aliased_share.reset();
  }
  return Surface(surface.grid(), std::move(z), std::move(traits));
}

Profile levelled(const Profile& profile, int degree) {
  check_degree(degree);
  if (profile.closed() && degree > 0)
    throw Error(ErrorCode::bad_value,
                "a closed outline was to be levelled with `degree` " + std::to_string(degree),
                "an outline has no ends between which to tilt; use `degree` 0");
  Field z(profile.size(), 1);
  std::copy(profile.heights().begin(), profile.heights().end(), z.values().begin());
  level(z, degree);
  return Profile(profile.spacing(), Array<double>(z.values().begin(), z.values().end()),
                 profile.closed_radius());
}

}  // namespace asperity
