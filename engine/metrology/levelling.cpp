// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/levelling.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/require.hpp"
#include "engine/metrology/blocked_sums.hpp"
#include "engine/statistics/least_squares.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

// Polynomials of degree 0, 1, … over n equally spaced nodes, orthonormal there.
class OrthonormalPolynomials {
 public:
  // Orthogonalised twice (Gram–Schmidt) to reach rounding; at most n polynomials.
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

  Field table_;  // row k: polynomial k
};

void check_degree(int degree) {
  if (degree < 0 || degree > max_levelling_degree)
    refuse("`degree` of levelling is " + std::to_string(degree),
           "give 0 (mean), 1 (plane), 2 (quadratic) … " + std::to_string(max_levelling_degree));
}

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
  // Coefficients in x per row, then in y.
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

// The second pass removes the rounding of a large fit.
void level_complete(Field& z, int degree) {
  const OrthonormalPolynomials along_x(z.nx(), degree), along_y(z.ny(), degree);
  for (int pass = 0; pass < 2; ++pass) subtract_fit(z, along_x, along_y, degree);
}

// Polynomial products over the bounding rectangle of measured nodes.
class MaskedPolynomials {
 public:
  MaskedPolynomials(const Field& z, int degree)
      : box_(around_known(z)), along_x_(box_.width(), degree), along_y_(box_.height(), degree) {
    for (int a = 0; a < along_x_.count(); ++a)
      for (int b = 0; b < along_y_.count() && a + b <= degree; ++b) terms_.push_back({a, b});
  }

  std::size_t count() const { return terms_.size(); }
  int first_row() const { return box_.low; }
  int rows() const { return box_.height(); }
  // Adds a row: Σ polynomial · z, and Σ products unless `gram` is empty.
  void add_row(const Field& z, int j, std::span<double> gram, std::span<double> moments) const {
    std::vector<double> at(count());
    for (int i = box_.left; i <= box_.right; ++i) {
      const double height = z(i, j);
      if (std::isnan(height)) continue;
      evaluate(i, j, at);
      for (std::size_t p = 0; p < at.size(); ++p) {
        moments[p] += at[p] * height;
        for (std::size_t q = 0; q <= p && !gram.empty(); ++q) gram[p * at.size() + q] += at[p] * at[q];
      }
    }
  }
  void subtract_row(Field& z, int j, std::span<const double> coefficients) const {
    std::vector<double> at(count());
    for (int i = box_.left; i <= box_.right; ++i) {
      evaluate(i, j, at);
      z(i, j) -= dot(coefficients, at);
    }
  }

 private:
  struct Box {
    int left, right, low, high;
    int width() const { return right - left + 1; }
    int height() const { return high - low + 1; }
  };
  struct Term {
    int a, b;
  };
  static Box around_known(const Field& z) {
    Box box{z.nx() - 1, 0, z.ny() - 1, 0};
    for (int j = 0; j < z.ny(); ++j)
      for (int i = 0; i < z.nx(); ++i)
        if (!std::isnan(z(i, j)))
          box = {std::min(box.left, i), std::max(box.right, i), std::min(box.low, j), std::max(box.high, j)};
    return box;
  }
  void evaluate(int i, int j, std::vector<double>& at) const {
    const auto x = static_cast<std::size_t>(i - box_.left), y = static_cast<std::size_t>(j - box_.low);
    for (std::size_t p = 0; p < at.size(); ++p) at[p] = along_x_[terms_[p].a][x] * along_y_[terms_[p].b][y];
  }

  Box box_;
  OrthonormalPolynomials along_x_, along_y_;
  std::vector<Term> terms_;
};

// Tiny eigenvalues of the products mark combinations that duplicate others on the nodes. Further passes
// remove rounding.
void level_measured(Field& z, int degree) {
  const MaskedPolynomials polynomials(z, degree);
  const std::size_t n = polynomials.count(), each = n * n + n;
  SingularValues products;
  constexpr int passes = 4;
  constexpr double hardly_seen = 1e-11;
  for (int pass = 0; pass < passes; ++pass) {
    Field of_rows(polynomials.rows(), static_cast<int>(each));
    for_each_row(polynomials.rows(), [&](int row) {
      std::vector<double> sums(each);
      polynomials.add_row(z, polynomials.first_row() + row, std::span(sums).first(pass == 0 ? n * n : 0),
                          std::span(sums).subspan(n * n));
      for (std::size_t k = 0; k < each; ++k) of_rows(row, static_cast<int>(k)) = sums[k];
    });
    TableColumns gram(n, std::vector<double>(n));
    std::vector<double> moments(n), coefficients(n);
    for (std::size_t p = 0; p < n; ++p) {
      moments[p] = block_sum(of_rows.row(static_cast<int>(n * n + p)));
      for (std::size_t q = 0; q <= p && pass == 0; ++q)
        gram[p][q] = gram[q][p] = block_sum(of_rows.row(static_cast<int>(p * n + q)));
    }
    if (pass == 0) products = singular_values(gram);
    for (std::size_t k = 0; k < n && products.values[k] > hardly_seen * products.values[0]; ++k) {
      const double share = dot(products.v[k], moments) / products.values[k];
      for (std::size_t p = 0; p < n; ++p) coefficients[p] += share * products.v[k][p];
    }
    for_each_row(polynomials.rows(),
                 [&](int row) { polynomials.subtract_row(z, polynomials.first_row() + row, coefficients); });
  }
}

void level(Field& z, int degree, bool complete) {
  for (int pass = 0; pass < 2; ++pass) {
    const double mean = mean_of_known(z, !complete);
    for_each_row(z.ny(), [&](int j) {
      for (double& value : z.row(j)) value -= mean;
    });
  }
  if (degree > 0) (complete ? level_complete : level_measured)(z, degree);
}

}  // namespace

Surface levelled(const Surface& surface, int degree) {
  check_degree(degree);
  Field z = surface.measured_heights();
  level(z, degree, surface.complete());
  SurfaceTraits traits = surface.traits();
  if (degree > 0) {
    traits.periodic = false;
    traits.aliased_share.reset();
  }
  return remade_with(!surface.complete(), surface.grid(), std::move(z), std::move(traits));
}

Profile levelled(const Profile& profile, int degree) {
  check_degree(degree);
  if (profile.closed() && degree > 0)
    refuse("a closed outline cannot be levelled with `degree` " + std::to_string(degree),
           "give `degree` 0: an outline has no tilt");
  Field z = line_of(profile);
  level(z, degree, profile.complete());
  return remade_with(!profile.complete(), profile.spacing(), samples_of(z), profile.closed_radius());
}

}  // namespace asperity
