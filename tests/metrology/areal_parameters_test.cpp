// SPDX-License-Identifier: GPL-3.0-or-later
// Five maps with formulas (tests/reference/metrology_maps.csv), on which two independent programs agree,
// and exact gauges.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "engine/core/error.hpp"
#include "engine/metrology/parameters/areal_parameters.hpp"
#include "engine/metrology/parameters/autocorrelation.hpp"
#include "engine/metrology/parameters/hills.hpp"
#include "engine/metrology/parameters/material_ratio.hpp"
#include "engine/metrology/scale_dependence.hpp"

namespace asperity::areal_parameters_test {
namespace {

using std::numbers::pi;
const double golden = (std::sqrt(5.0) - 1) / 2;
double part(double v) { return v - std::floor(v); }

struct Waves {
  int count;
  double phase, hurst, first, last, across;
};

Field sum_of_waves(int nx, int ny, const Waves& w) {
  Field z(nx, ny);
  for (int k = 1; k <= w.count; ++k) {
    const double q = w.first * std::pow(w.last / w.first, (k - 1.0) / (w.count - 1)),
                 t = 2 * pi * part(k * std::sqrt(2.0) + w.phase);
    const double u = std::rint(q * std::cos(t)), v = std::rint(w.across * q * std::sin(t)),
                 phase = part(k * golden + w.phase), height = std::pow(q, -(1 + w.hurst));
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) z(i, j) += height * std::cos(2 * pi * (u * i / nx + v * j / ny + phase));
  }
  return z;
}

Surface p1() {
  Field z = sum_of_waves(256, 256, {400, .123, .8, 4, 60, 1});
  for (double& h : z.values()) h *= 10;
  return Surface(Grid{256, 256, 256, 256}, std::move(z));
}
Surface p2() {
  Field z = sum_of_waves(300, 200, {300, .7, .6, 6, 50, .12});
  for (double& h : z.values()) h *= 4;
  return Surface(Grid{300, 200, 150, 250}, std::move(z));
}
Surface p3() {
  Field z = sum_of_waves(256, 256, {400, .9, .8, 4, 60, 1});
  double squares = 0;
  for (const double h : z.values()) squares += h * h;
  const double rms = std::sqrt(squares / static_cast<double>(z.size()));
  for (int j = 0; j < 256; ++j)
    for (int i = 0; i < 256; ++i) {
      double h = z(i, j) / rms;
      if (h > .3) h = .3 + .1 * (h - .3);
      for (const double g : {pi / 6, -pi / 6}) {
        const double d = (part((i * std::cos(g) + j * std::sin(g)) / 37) - .5) * 37 / 2.5;
        h -= 1.5 * std::exp(-d * d);
      }
      z(i, j) = h;
    }
  return Surface(Grid{256, 256, 256, 256}, std::move(z));
}
Surface p4() {
  Field z = p1().heights();
  for (int j = 0; j < 256; ++j)
    for (int i = 0; i < 256; ++i)
      for (int k = 1; k <= 40; ++k) {
        const double x = i - 256 * part(k * golden + .05), y = j - 256 * part(k * std::sqrt(2.0) + .05),
                     r = 2 + 8 * part(k * std::sqrt(3.0) + .05);
        if (x * x + y * y <= r * r) z(i, j) = std::numeric_limits<double>::quiet_NaN();
      }
  return Surface::with_holes(Grid{256, 256, 256, 256}, std::move(z));
}
Surface p5() {
  Field z(256, 256);
  for (int k = 1; k <= 900; ++k) {
    const double depth = 2 * part(k * std::sqrt(3.0) + .35), x = 256 * part(k * golden + .35),
                 y = 256 * part(k * std::sqrt(2.0) + .35), R = 22;
    for (int j = 0; j < 256; ++j)
      for (int i = 0; i < 256; ++i) {
        const double r2 = (i - x) * (i - x) + (j - y) * (j - y);
        if (r2 < R * R) z(i, j) = std::min(z(i, j), -depth + R - std::sqrt(R * R - r2));
      }
  }
  return Surface(Grid{256, 256, 256, 256}, std::move(z));
}

std::map<std::string, double> reference(const std::string& map) {
  std::ifstream file(ASPERITY_TEST_DATA "/metrology_maps.csv");
  EXPECT_TRUE(file) << "no reference";
  std::map<std::string, double> values;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::string name, parameter, number;
    std::getline(cells, name, ',');
    std::getline(cells, parameter, ',');
    std::getline(cells, number, ',');
    if (name == map && !number.empty()) values[parameter] = std::stod(number);
  }
  return values;
}

class ArealParametersOfMap : public testing::TestWithParam<const char*> {
 protected:
  static const Surface& surface() {
    static const std::map<std::string, Surface> maps{
        {"P1", p1()}, {"P2", p2()}, {"P3", p3()}, {"P4", p4()}, {"P5", p5()}};
    return maps.at(GetParam());
  }
};

// Within 1e-9 or the printed digits.
void expect_near(double value, double wanted, double relative, const char* name) {
  EXPECT_NEAR(value, wanted, relative * std::abs(wanted) + 1e-12) << name;
}

TEST_P(ArealParametersOfMap, CurveSlopesAndHillsAreTheReferences) {
  const Surface& s = surface();
  auto wanted = reference(GetParam());
  ASSERT_GT(wanted.size(), 40u);
  EXPECT_EQ(static_cast<double>(s.measured()), wanted["n_measured"]);
  const MaterialRatioCurve curve(s.measured_heights().values());
  const CoreOfCurve core = curve.core();
  const VolumesOfCurve volumes = curve.volumes();
  const double near = 1e-9;
  expect_near(core.Sk, wanted["Sk"], near, "Sk");
  expect_near(core.Spk, wanted["Spk"], near, "Spk");
  expect_near(core.Svk, wanted["Svk"], near, "Svk");
  expect_near(core.Smr1 * 100, wanted["Smr1"], near, "Smr1");
  expect_near(core.Smr2 * 100, wanted["Smr2"], near, "Smr2");
  expect_near(core.Spkx, wanted["Spkx"], near, "Spkx");
  expect_near(core.Svkx, wanted["Svkx"], near, "Svkx");
  expect_near(core.window * 100, wanted["sk_window_start"], near, "window");
  expect_near(curve.height(.1), wanted["Smc10"], near, "Smc10");
  expect_near(curve.height(.8), wanted["Smc80"], near, "Smc80");
  expect_near(curve.height_difference(.025, .5), wanted["Sxp"], near, "Sxp");
  expect_near(volumes.Vmp, wanted["Vmp"], near, "Vmp");
  expect_near(volumes.Vmc, wanted["Vmc"], near, "Vmc");
  expect_near(volumes.Vvv, wanted["Vvv"], near, "Vvv");
  expect_near(volumes.Vvc, wanted["Vvc"], near, "Vvc");
  expect_near(curve.ratio(curve.height(0) / 2) * 100, wanted["Smr_at_half_Sp"], near, "Smr at half Sp");

  const ArealSlopes slopes = areal_slopes(s);
  expect_near(slopes.Sdq.value(), wanted["Sdq_edge"], near, "Sdq");
  expect_near(slopes.Sdq_seven.value(), wanted["Sdq_7"], near, "Sdq of seven");
  expect_near(slopes.Sdr.value(), wanted["Sdr"], near, "Sdr");

  const Hills h = hills(s);
  EXPECT_EQ(static_cast<double>(h.peaks), wanted["n_peaks"]);
  EXPECT_EQ(static_cast<double>(h.pits), wanted["n_pits"]);
  expect_near(h.Spd, wanted["Spd"], near, "Spd");
  expect_near(h.Svd, wanted["Svd"], near, "Svd");
  if (wanted.contains("Spc") && !std::isnan(wanted["Spc"]))
    expect_near(h.Spc.value(), wanted["Spc"], near, "Spc");
  for (const auto& [name, value] : {std::pair{"S5p", h.S5p}, {"S5v", h.S5v}, {"S10z", h.S10z}})
    if (wanted.contains(name) && !std::isnan(wanted[name]))
      expect_near(value.value(), wanted[name], near, name);
}

TEST_P(ArealParametersOfMap, TextureIsTheReferences) {
  const Surface& s = surface();
  auto wanted = reference(GetParam());
  const TextureAspect texture = Autocorrelation(s).texture();
  expect_near(texture.Sal.value(), wanted["Sal"], 1e-3, "Sal");
  if (std::isnan(wanted["Str"]))
    expect_near(texture.Str_bound.value(), wanted["Str_upper_bound_if_clipped"], 2e-3, "bound of Str");
  else
    expect_near(texture.Str.value(), wanted["Str"], 2e-3, "Str");
  const double wave = texture_direction(s).wave * 180 / pi;
  EXPECT_LE(std::min(std::abs(wave - wanted["Std_wave"]), 180 - std::abs(wave - wanted["Std_wave"])),
            .5 + 1e-9);
}

TEST_P(ArealParametersOfMap, ScalesAreTheReferences) {
  const Surface& s = surface();
  auto wanted = reference(GetParam());
  const ScaleDependence slope = scale_dependence(s, ScaleQuantity::slope, ScaleAxis::x, {1, 4, 16}),
                        curvature = scale_dependence(s, ScaleQuantity::curvature, ScaleAxis::x, {1, 4, 16});
  expect_near(slope.value[0], wanted["slope_x_lag1"], 1e-9, "slope over a cell");
  expect_near(slope.value[1], wanted["slope_x_lag4"], 1e-9, "slope over four");
  expect_near(slope.value[2], wanted["slope_x_lag16"], 1e-9, "slope over sixteen");
  expect_near(curvature.value[0], wanted["curv_x_stencil2"], 1e-9, "curvature over two");
  expect_near(curvature.value[1], wanted["curv_x_stencil8"], 1e-9, "curvature over eight");
  expect_near(curvature.value[2], wanted["curv_x_stencil32"], 1e-9, "curvature over 32");
  EXPECT_EQ(curvature.distance[2], 32 * s.grid().hx());
  expect_near(height_in_blocks(s, 1), wanted["vb_rms_1x1"], 1e-9, "one block");
  expect_near(height_in_blocks(s, 4), wanted["vb_rms_4x4"], 1e-9, "blocks of a quarter");
  expect_near(height_in_blocks(s, 16), wanted["vb_rms_16x16"], 1e-9, "blocks of a sixteenth");
  EXPECT_NEAR(tip_cut_off(s, ScaleAxis::x, 10), wanted["tip_cutoff_R10"], 1e-9);
  EXPECT_NEAR(tip_cut_off(s, ScaleAxis::x, 100), wanted["tip_cutoff_R100"], 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Maps, ArealParametersOfMap, testing::Values("P1", "P2", "P3", "P4", "P5"),
                         [](const auto& map) { return std::string(map.param); });

template <class Height>
Surface of(int nx, int ny, double dx, double dy, const Height& height) {
  Field z(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) z(i, j) = height(i, j);
  return Surface::with_holes(Grid{nx, ny, nx * dx, ny * dy}, std::move(z));
}

TEST(ArealGauges, PlaneHasItsSlopeAndItsAreaWithAHoleToo) {
  for (const bool hole : {false, true}) {
    const Surface plane = of(101, 81, .5, .8, [=](int i, int j) {
      return hole && (i - 40) * (i - 40) + (j - 30) * (j - 30) <= 200 ? NAN : .3 * .5 * i - .2 * .8 * j;
    });
    const ArealSlopes slopes = areal_slopes(plane);
    expect_near(slopes.Sdq.value(), 0.360555127546399, 1e-12, "Sdq");
    expect_near(slopes.Sdq_seven.value(), 0.360555127546399, 1e-12, "Sdq of seven");
    expect_near(slopes.Sdr.value(), 0.0630145812734649, 1e-12, "Sdr");
  }
  const ArealSlopes flat = areal_slopes(of(65, 65, 1, 1, [](int, int) { return 7.0; }));
  EXPECT_EQ(flat.Sdr.value(), 0);
  EXPECT_EQ(flat.Sdq.value(), 0);
}

TEST(ArealGauges, SineInTwoDirections) {
  const Surface s = of(256, 256, .5, .5, [](int i, int j) {
    return 2 * std::sin(2 * pi * i / 32) * std::sin(2 * pi * j / 32);
  });
  const Hills h = hills(s);
  expect_near(h.Spc.value(), 0.307435513548313, 1e-9, "Spc");
  expect_near(h.S10z.value(), 4, 1e-12, "S10z");
  EXPECT_EQ(h.Spd, 0.0078125);
}

TEST(ArealGauges, StepHasACoreOfNoHeight) {
  const Surface s = of(200, 50, .5, .5, [](int i, int) { return i >= 140 ? 1.5 : 0.0; });
  expect_near(areal_slopes(s).Sdq.value(), 0.212664361502501, 1e-9, "Sdq");
  expect_near(areal_slopes(s).Sdr.value(), 0.0108657168852682, 1e-9, "Sdr");
  EXPECT_NEAR(MaterialRatioCurve(s.measured_heights().values()).core().Sk, 0, 1e-12);
}

TEST(ArealGauges, Chequerboard) {
  const Surface s = of(240, 240, 1, 1, [](int i, int j) { return (i / 12 + j / 12) % 2 == 0 ? 1.0 : 0.0; });
  expect_near(areal_slopes(s).Sdq.value(), 0.398742794166342, 1e-9, "Sdq");
  expect_near(areal_slopes(s).Sdr.value(), 0.0652491329453518, 1e-9, "Sdr");
  expect_near(Autocorrelation(s)(3, 0), 0.518987341772152, 1e-9, "a quarter of a square");
}

TEST(ArealGauges, SineHasNoAspectOfTextureButABound) {
  const Surface s = of(256, 256, 1, 1, [](int i, int) { return std::sin(2 * pi * i / 16); });
  const TextureAspect texture = Autocorrelation(s).texture();
  expect_near(texture.Sal.value(), 3.51161207331, 1e-3, "Sal");
  EXPECT_FALSE(texture.Str);
  expect_near(texture.Str_bound.value(), 0.0274250682153, 2e-3, "bound of Str");
  EXPECT_EQ(texture_direction(s).wave, 0);
  EXPECT_EQ(texture_direction(s).lay, pi / 2);
}

TEST(ArealGauges, CurveOfGaussianHeights) {
  // Height k of 65536 has the ratio (k - 0.5)/65536; bisection solves σ √2 erfinv(1 - 2p).
  Array<double> heights(65536);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double wanted = 1 - 2 * (static_cast<double>(k) + .5) / 65536;
    double low = -6, high = 6;
    for (int step = 0; step < 56; ++step)
      (std::erf((low + high) / 2) < wanted ? low : high) = (low + high) / 2;
    heights[k] = std::sqrt(2.0) * (low + high) / 2;
  }
  const MaterialRatioCurve curve(heights);
  const CoreOfCurve core = curve.core();
  expect_near(core.Sk, 2.5739146474, 1e-9, "Sk");
  expect_near(core.Spk, 0.944619788833, 1e-9, "Spk");
  expect_near(core.Svk, 0.944621026929, 1e-9, "Svk");
  expect_near(core.Smr1, 0.0990481442992, 1e-9, "Smr1");
  expect_near(core.Smr2, 0.901, 1e-3, "Smr2");
  const VolumesOfCurve volumes = curve.volumes();
  expect_near(volumes.Vmp, 0.0473230620976, 1e-9, "Vmp");
  expect_near(volumes.Vmc, 0.905896798344, 1e-9, "Vmc");
  expect_near(volumes.Vvv, 0.111614977682, 1e-9, "Vvv");
  expect_near(volumes.Vvc, 1.21722487375, 1e-9, "Vvc");
  for (const double p : {.1, .37, .8})
    EXPECT_NEAR(curve.void_volume(p) - curve.material_volume(p), curve.height(p), 8.0 / 65536) << p;
}

TEST(ArealGauges, SlopesOfAPeriodicMapAreThoseOfItsWaves) {
  SurfaceTraits periodic;
  periodic.periodic = true;
  const Surface s(Grid{256, 256, 256, 256}, p1().heights(), periodic);
  const ScaleDependence slope = scale_dependence(s, ScaleQuantity::slope, ScaleAxis::x, {1, 2, 4, 8, 16, 32});
  const double wanted[] = {0.38639446750056,  0.383788557209058, 0.375004196181624,
                           0.351184643285137, 0.294457319365672, 0.17960528694111};
  for (std::size_t k = 0; k < 6; ++k) expect_near(slope.value[k], wanted[k], 1e-12, "slope");
}

TEST(ArealParameters, WhatIsNotDefinedIsNoNumber) {
  const Surface flat = of(8, 8, 1, 1, [](int, int) { return 2.0; });
  const CoreOfCurve core = MaterialRatioCurve(flat.measured_heights().values()).core();
  EXPECT_EQ(core.Sk, 0);
  EXPECT_EQ(core.Spk, 0);
  EXPECT_EQ(hills(flat).peaks, 0u);
  EXPECT_FALSE(hills(flat).S10z);
  EXPECT_FALSE(hills(flat).Spc);
  EXPECT_THROW(Autocorrelation{flat}, Error);
  EXPECT_THROW(texture_direction(flat), Error);
  const Surface row = of(8, 1, 1, 1, [](int i, int) { return i % 2 * 1.0; });
  EXPECT_FALSE(areal_slopes(row).Sdr);
  EXPECT_EQ(areal_slopes(row).Sdq.value(), 1);
  EXPECT_THROW(Autocorrelation{row}, Error);
}

TEST(ArealParameters, CopiesShareTheCache) {
  const ArealParameters p(p2());
  const ArealParameters copy = p;
  EXPECT_EQ(&copy.heights(), &p.heights());
  EXPECT_EQ(&p.curve(), &copy.curve());
}

TEST(ArealParameters, WithoutPruningHillsAreNoise) {
  const Surface map = p1();
  EXPECT_EQ(hills(map, 0).peaks, 135u);
  EXPECT_EQ(hills(map, .01).peaks, 58u);
  EXPECT_EQ(hills(map, .1).peaks, 20u);
}

TEST(ArealParameters, OneSpikeTakesTheHillsWithIt) {
  const Surface s = of(64, 64, 1, 1, [](int i, int j) {
    return i == 31 && j == 20 ? 1000.0 : std::sin(2 * pi * i / 16) * std::sin(2 * pi * j / 16);
  });
  EXPECT_EQ(hills(s).peaks, 1u);
  EXPECT_FALSE(hills(s).S5p);
}

TEST(ArealParameters, KeepTheirDigitsOnAGreatOffset) {
  const Surface low =
      of(64, 64, 1, 1, [](int i, int j) { return std::sin(i * .7) + std::cos(j * 1.3 + i * .2); });
  const Surface high = of(64, 64, 1, 1, [](int i, int j) {
    return 4096 + std::ldexp(std::rint(std::ldexp(std::sin(i * .7) + std::cos(j * 1.3 + i * .2), 30)), -30);
  });
  const CoreOfCurve a = MaterialRatioCurve(low.heights().values()).core(),
                    b = MaterialRatioCurve(high.heights().values()).core();
  EXPECT_NEAR(a.Sk, b.Sk, 1e-8);
  EXPECT_NEAR(a.Spk, b.Spk, 1e-8);
}

}  // namespace
}  // namespace asperity::areal_parameters_test
