// SPDX-License-Identifier: GPL-3.0-or-later
// Hanaor, Gan & Einav (2013): Weierstrass–Mandelbrot surfaces of 150 x 150 cells as box elements on a rigid
// flat, against independently computed tables. Single cases to 1e-8, means over seeds 1–20 to the last
// printed digit; definitions for which the trends fail. Preset A: span 1, B: span 3. Raw heights with
// stiffness 1/peak-to-valley replace unit peak-to-valley and E = 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>

#include "engine/contact/solver.hpp"
#include "engine/friction/junction_law.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::paper_tables_test {
namespace {

// raw: mean peak-to-valley of the preset at D = 2.
enum class Scaling { peak_to_valley, six_sd, ten_ra, percentiles, raw };
enum class Cap { none, yield, absolute };
constexpr std::array ratios = {0.1, 1.0, 10.0, 100.0};
constexpr double tau0 = 0.01;

const Surface& heights(char preset, double D, int seed, WaveBand band = WaveBand::all) {
  static std::map<std::tuple<char, double, int, WaveBand>, Surface> made;
  const auto key = std::tuple{preset, D, seed, band};
  if (const auto found = made.find(key); found != made.end()) return found->second;
  WeierstrassMandelbrotOptions options;
  options.nx = options.ny = 150;
  options.D = D;
  options.span = preset == 'A' ? 1 : 3;
  options.seed = static_cast<std::uint64_t>(seed);
  options.band = band;
  return made.emplace(key, weierstrass_mandelbrot(options)).first->second;
}

double percentile(std::vector<double> sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

// The amplitude A in P = E δ/A.
double amplitude(char preset, const Surface& z, Scaling scaling) {
  const std::span<const double> values = z.heights().values();
  const double centre = mean(values);
  double squares = 0, absolute = 0;
  for (const double v : values) {
    squares += (v - centre) * (v - centre);
    absolute += std::abs(v - centre);
  }
  const auto n = static_cast<double>(values.size());
  switch (scaling) {
    case Scaling::peak_to_valley:
      return z.peak_to_valley();
    case Scaling::six_sd:
      return 6 * std::sqrt(squares / n);
    case Scaling::ten_ra:
      return 10 * absolute / n;
    case Scaling::percentiles: {
      std::vector<double> sorted(values.begin(), values.end());
      std::sort(sorted.begin(), sorted.end());
      return percentile(sorted, 0.999) - percentile(sorted, 0.001);
    }
    case Scaling::raw: {
      double sum = 0;
      for (int seed = 1; seed <= 20; ++seed) sum += heights(preset, 2.0, seed).peak_to_valley();
      return sum / 20;
    }
  }
  return 0;
}

State pressed(char preset, double D, int seed, double pressure = 0.01,
              Scaling scaling = Scaling::peak_to_valley, WaveBand band = WaveBand::all) {
  const Surface& z = heights(preset, D, seed, band);
  return test::press(test::boxes(z, 1 / amplitude(preset, z, scaling)), PressBy::pressure, pressure);
}

double mu_of(const State& st, double ratio, Cap cap) {
  FrictionOptions options;
  options.tau0 = tau0;
  options.alpha = ratio * tau0;
  if (cap == Cap::yield) options.yield_pressure = 0.2;
  if (cap == Cap::absolute) options.tau_max = 2 * tau0;
  return JunctionLaw(options).on(st).mu.value();
}

struct Statistics {
  double mean = 0, sd = 0, up = 0;  // up: share of values above 1
};

Statistics over_seeds(const std::function<double(int seed)>& value) {
  std::vector<double> values;
  for (int seed = 1; seed <= 20; ++seed) values.push_back(value(seed));
  Statistics result;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) result.mean += v / n;
  for (const double v : values) {
    result.sd += (v - result.mean) * (v - result.mean) / (n - 1);
    result.up += v > 1 ? 1 / n : 0;
  }
  result.sd = std::sqrt(result.sd);
  return result;
}

using Quantity = std::function<double(const State&)>;

double depth_of(const State& st) { return st.indentation(); }
double area_of(const State& st) { return st.area_fraction(); }
double secant_of(const State& st) { return 0.01 / st.indentation(); }
double spots_of(const State& st) { return static_cast<double>(st.spots()); }
double spots8_of(const State& st) { return static_cast<double>(st.spots8()); }

Statistics statistics(char preset, double D, const Quantity& quantity) {
  return over_seeds([&](int seed) { return quantity(pressed(preset, D, seed)); });
}

// The ratio of a quantity to its value at D = 2.
Statistics ratio_to_two(char preset, double D, const Quantity& quantity, double pressure = 0.01) {
  return over_seeds([&](int seed) {
    return quantity(pressed(preset, D, seed, pressure)) / quantity(pressed(preset, 2.0, seed, pressure));
  });
}
// To one unit of the last digit: "1.24" to 0.01, ".0354" to 0.0001.
void expect_printed(double value, const std::string& printed, const std::string& what) {
  const auto point = printed.find('.');
  const auto decimals = point == std::string::npos ? 0 : static_cast<int>(printed.size() - point - 1);
  EXPECT_NEAR(value, std::stod(printed), 1.0001 * std::pow(10.0, -decimals)) << what;
}

double decade(int k) { return (20 + k) / 10.0; }  // D = 2.0 … 2.9

TEST(PaperTables, SingleCases) {
  std::ifstream file(std::string(ASPERITY_TEST_DATA) + "/box_contact.csv");
  std::string line;
  int cases = 0;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || line.starts_with("preset")) continue;
    std::istringstream cells(line);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    ASSERT_EQ(cell.size(), 15U);
    auto number = [&](std::size_t column) { return std::stod(cell[column]); };
    const char preset = cell[0][0];
    const int seed = std::stoi(cell[2]);
    auto relative = [&](double value, std::size_t column) {
      EXPECT_NEAR(value, number(column), 1e-8 * number(column)) << line << " column " << column;
    };
    const Surface& z = heights(preset, number(1), seed);
    const State st = pressed(preset, number(1), seed);
    relative(z.peak_to_valley(), 3);
    relative(amplitude(preset, z, Scaling::six_sd) / 6 / z.peak_to_valley(), 4);
    relative(st.indentation(), 5);
    EXPECT_NEAR(static_cast<double>(st.contacts()), number(6), 1) << line;
    relative(st.secant_stiffness() * z.peak_to_valley(), 7);
    EXPECT_NEAR(static_cast<double>(st.spots()), number(8), 2) << line;
    EXPECT_NEAR(static_cast<double>(st.spots8()), number(9), 2) << line;
    relative(mu_of(st, 10, Cap::none), 10);
    relative(mu_of(st, 10, Cap::yield), 11);
    relative(mu_of(st, 10, Cap::absolute), 12);
    ++cases;
  }
  EXPECT_EQ(cases, 15);
}

// Table 3.1: definitions of the amplitude, D 2.0 → 2.9.
TEST(PaperTables, DefinitionsOfTheAmplitude) {
  struct Row {
    Scaling scaling;
    std::array<const char*, 3> A, B;  // ratios of d/PV, area, secant
  };
  const std::array rows = {
      Row{Scaling::peak_to_valley, {"1.47", "1.24", "0.69"}, {"1.13", "1.17", "0.89"}},
      Row{Scaling::six_sd, {"1.34", "0.90", "0.50"}, {"1.09", "0.97", "0.74"}},
      Row{Scaling::ten_ra, {"1.28", "0.92", "0.51"}, {"1.07", "0.97", "0.74"}},
      Row{Scaling::percentiles, {"1.43", "1.05", "0.58"}, {"1.11", "1.03", "0.77"}},
      Row{Scaling::raw, {"1.64", "2.03", "1.16"}, {"1.33", "2.29", "1.81"}},
  };
  for (const Row& row : rows)
    for (const char preset : {'A', 'B'}) {
      auto ratio = [&](auto quantity) {
        return over_seeds([&](int seed) {
          return quantity(pressed(preset, 2.9, seed, 0.01, row.scaling), heights(preset, 2.9, seed)) /
                 quantity(pressed(preset, 2.0, seed, 0.01, row.scaling), heights(preset, 2.0, seed));
        });
      };
      const auto& expected = preset == 'A' ? row.A : row.B;
      const std::string what =
          std::string(1, preset) + " scaling " + std::to_string(static_cast<int>(row.scaling));
      expect_printed(ratio([](const State& st, const Surface&) { return st.indentation(); }).mean,
                     expected[0], what);
      expect_printed(ratio([](const State& st, const Surface&) { return st.area_fraction(); }).mean,
                     expected[1], what);
      expect_printed(ratio([&](const State& st, const Surface& z) {
                       return st.secant_stiffness() * amplitude(preset, z, row.scaling);
                     }).mean,
                     expected[2], what);
    }
}

TEST(PaperTables, SpreadAndSignOfTheRatiosToDTwo) {
  auto ratio = [](char preset, const Quantity& quantity) { return ratio_to_two(preset, 2.9, quantity); };
  const std::array expected = {
      std::tuple{ratio('A', depth_of), ".19", 1.0},  std::tuple{ratio('A', area_of), ".24", .90},
      std::tuple{ratio('A', secant_of), ".09", 0.0}, std::tuple{ratio('B', depth_of), ".12", .85},
      std::tuple{ratio('B', area_of), ".08", 1.0},   std::tuple{ratio('B', secant_of), ".09", .15},
  };
  for (const auto& [found, sd, up] : expected) {
    expect_printed(found.sd, sd, "sd");
    EXPECT_NEAR(found.up, up, 1e-12);
  }
}

struct PresetRow {
  double D;
  const char *depth, *depth_sd, *area, *area_sd, *secant, *secant_sd, *spots4, *spots4_sd, *spots8;
};

void expect_printed(char preset, const PresetRow& row) {
  const std::string what = "D = " + std::to_string(row.D);
  const Statistics depth = statistics(preset, row.D, depth_of), area = statistics(preset, row.D, area_of);
  const Statistics secant = statistics(preset, row.D, secant_of),
                   spots4 = statistics(preset, row.D, spots_of);
  expect_printed(depth.mean, row.depth, what);
  expect_printed(depth.sd, row.depth_sd, what);
  expect_printed(area.mean, row.area, what);
  expect_printed(area.sd, row.area_sd, what);
  expect_printed(secant.mean, row.secant, what);
  expect_printed(secant.sd, row.secant_sd, what);
  expect_printed(spots4.mean, row.spots4, what);
  if (row.spots4_sd != nullptr) expect_printed(spots4.sd, row.spots4_sd, what);
  expect_printed(statistics(preset, row.D, spots8_of).mean, row.spots8, what);
}

// Table 3.3.
TEST(PaperTables, PresetA) {
  const std::array<PresetRow, 10> rows = {{
      {2.0, ".2623", ".0354", ".1274", ".0217", ".03877", ".00503", "10.3", "4.8", "8.6"},
      {2.1, ".2731", ".0355", ".1293", ".0211", ".03720", ".00467", "17.1", "7.0", "12.4"},
      {2.2, ".2842", ".0370", ".1312", ".0202", ".03575", ".00454", "27.3", "9.3", "19.3"},
      {2.3, ".2958", ".0392", ".1330", ".0194", ".03437", ".00451", "43.6", "14.1", "30.2"},
      {2.4, ".3105", ".0396", ".1357", ".0178", ".03271", ".00416", "76.0", "21.8", "49.0"},
      {2.5, ".3263", ".0402", ".1385", ".0157", ".03110", ".00389", "128.2", "33.6", "79.7"},
      {2.6, ".3409", ".0420", ".1420", ".0133", ".02977", ".00378", "212.9", "44.3", "131.6"},
      {2.7, ".3556", ".0405", ".1464", ".0111", ".02847", ".00324", "361.1", "62.9", "222.8"},
      {2.8, ".3676", ".0383", ".1497", ".0085", ".02747", ".00276", "618.2", "76.7", "386.1"},
      {2.9, ".3809", ".0321", ".1535", ".0069", ".02642", ".00215", "1105", "72", "711.4"},
  }};
  for (const PresetRow& row : rows) expect_printed('A', row);
}

// Table 3.3.
TEST(PaperTables, PresetB) {
  const std::array<PresetRow, 7> rows = {{
      {2.0, ".3211", ".0306", ".1325", ".0101", ".03141", ".00297", "42.5", nullptr, "37.0"},
      {2.1, ".3267", ".0293", ".1345", ".0101", ".03085", ".00272", "57.7", nullptr, "46.5"},
      {2.3, ".3377", ".0281", ".1390", ".0094", ".02980", ".00242", "121.3", nullptr, "86.7"},
      {2.5, ".3503", ".0294", ".1442", ".0075", ".02873", ".00241", "261.8", nullptr, "172.8"},
      {2.7, ".3606", ".0306", ".1505", ".0058", ".02793", ".00245", "598.8", nullptr, "380.4"},
      {2.8, ".3612", ".0298", ".1533", ".0072", ".02787", ".00233", "901.9", nullptr, "591.5"},
      {2.9, ".3616", ".0243", ".1549", ".0071", ".02777", ".00184", "1359.5", nullptr, "932.3"},
  }};
  for (const PresetRow& row : rows) expect_printed('B', row);
}

// Section 4: μ/μ(D = 2) at r = 0.1, 1, 10, 100; sd if printed.
TEST(PaperTables, FrictionRatios) {
  struct Row {
    char preset;
    Cap cap;
    double D;
    std::array<const char*, 4> mean, sd;
  };
  const std::array rows = {
      Row{'A', Cap::none, 2.5, {"1.0999", "1.0922", "1.0524", "1.0099"}, {".106", ".097", ".055", ".011"}},
      Row{'A', Cap::none, 2.9, {"1.2381", "1.2194", "1.1239", "1.0234"}, {".237", ".213", ".109", ".019"}},
      Row{'A', Cap::yield, 2.9, {"1.2382", "1.2203", "1.1268", "1.0253"}, {}},
      Row{'A', Cap::absolute, 2.9, {"1.2381", "1.2194", "1.1718", "1.2315"}, {}},
      Row{'B', Cap::none, 2.9, {"1.1726", "1.1614", "1.0979", "1.0199"}, {".079", ".073", ".043", ".009"}},
      Row{'B', Cap::yield, 2.9, {"1.1727", "1.1626", "1.1044", "1.0314"}, {}},
      Row{'B', Cap::absolute, 2.9, {"1.1726", "1.1614", "1.1330", "1.1677"}, {}},
  };
  for (const Row& row : rows)
    for (std::size_t r = 0; r < 4; ++r) {
      const Statistics found =
          ratio_to_two(row.preset, row.D, [&](const State& st) { return mu_of(st, ratios[r], row.cap); });
      const std::string what = std::string(1, row.preset) + " cap " +
                               std::to_string(static_cast<int>(row.cap)) +
                               " r = " + std::to_string(ratios[r]);
      expect_printed(found.mean, row.mean[r], what);
      if (row.sd[r] != nullptr) expect_printed(found.sd, row.sd[r], what);
    }
}

// Section 4: absolute μ at r = 10.
TEST(PaperTables, FrictionCoefficients) {
  auto mean_mu = [](char preset, double D, Cap cap) {
    return statistics(preset, D, [&](const State& st) { return mu_of(st, 10, cap); });
  };
  expect_printed(mean_mu('A', 2.0, Cap::none).mean, ".22744", "A 2.0");
  expect_printed(mean_mu('A', 2.0, Cap::none).sd, ".0217", "A 2.0 sd");
  expect_printed(mean_mu('A', 2.9, Cap::none).mean, ".25350", "A 2.9");
  expect_printed(mean_mu('A', 2.9, Cap::none).sd, ".0069", "A 2.9 sd");
  expect_printed(mean_mu('A', 2.0, Cap::yield).mean, ".22570", "A 2.0 yield");
  expect_printed(mean_mu('A', 2.9, Cap::yield).mean, ".25183", "A 2.9 yield");
  expect_printed(mean_mu('A', 2.0, Cap::absolute).mean, ".20615", "A 2.0 absolute");
  expect_printed(mean_mu('A', 2.9, Cap::absolute).mean, ".23678", "A 2.9 absolute");
  expect_printed(mean_mu('B', 2.0, Cap::none).mean, ".23248", "B 2.0");
  expect_printed(mean_mu('B', 2.9, Cap::none).mean, ".25492", "B 2.9");
}

// Table 3.2: other loads.
TEST(PaperTables, OtherLoads) {
  struct Row {
    char preset;
    double pressure;
    const char *least, *greatest, *area, *secant;  // range of d/A over all D and seeds; ratios 2.9 to 2.0
  };
  const std::array rows = {
      Row{'A', 0.005, "0.169", "0.427", "1.16", "0.63"}, Row{'A', 0.01, "0.210", "0.468", "1.24", "0.69"},
      Row{'A', 0.02, "0.263", "0.514", "1.30", "0.76"},  Row{'A', 0.03, "0.303", "0.545", "1.31", "0.79"},
      Row{'A', 0.04, nullptr, nullptr, "1.32", "0.82"},  Row{'B', 0.005, "0.228", "0.372", "1.15", "0.86"},
      Row{'B', 0.01, "0.272", "0.415", "1.17", "0.89"},  Row{'B', 0.02, "0.322", "0.467", "1.18", "0.92"},
      Row{'B', 0.03, "0.356", "0.502", "1.17", "0.94"},  Row{'B', 0.04, nullptr, nullptr, "1.17", "0.96"},
  };
  for (const Row& row : rows) {
    const std::string what = std::string(1, row.preset) + " p' = " + std::to_string(row.pressure);
    auto ratio = [&](const Quantity& quantity) {
      return ratio_to_two(row.preset, 2.9, quantity, row.pressure).mean;
    };
    expect_printed(ratio(area_of), row.area, what);
    expect_printed(ratio([](const State& st) { return 1 / st.indentation(); }), row.secant, what);
    if (row.least == nullptr) continue;
    double least = 1, greatest = 0;
    for (int k = 0; k < 10; ++k)
      for (int seed = 1; seed <= 20; ++seed) {
        const double depth = pressed(row.preset, decade(k), seed, row.pressure).indentation();
        least = std::min(least, depth);
        greatest = std::max(greatest, depth);
      }
    expect_printed(least, row.least, what);
    expect_printed(greatest, row.greatest, what);
  }
}

TEST(PaperTables, AtConstantDisplacementTheLoadFalls) {
  auto mean_pressure = [](char preset, double D) {
    return over_seeds([&](int seed) {
             return test::press(
                        test::boxes(heights(preset, D, seed), 1 / heights(preset, D, seed).peak_to_valley()),
                        PressBy::indentation, 0.3)
                 .pressure();
           })
        .mean;
  };
  expect_printed(mean_pressure('A', 2.0), "0.0169", "A 2.0");
  expect_printed(mean_pressure('A', 2.9), "0.0028", "A 2.9");
  expect_printed(mean_pressure('B', 2.0), "0.0081", "B 2.0");
  expect_printed(mean_pressure('B', 2.9), "0.0038", "B 2.9");
}

// Section 6: seeds 1–20 against the mean and sd of 150 other seeds.
TEST(PaperTables, PopulationBands) {
  struct Row {
    char preset;
    WaveBand band;
    double D;
    std::array<double, 14> expected;  // mean and sd of d, area, secant, μ at the four ratios
  };
  const std::array rows = {
      Row{'A',
          WaveBand::all,
          2.5,
          {1.218, .122, 1.100, .116, 0.829, .082, 1.099, .115, 1.091, .105, 1.051, .059, 1.009, .011}},
      Row{'A',
          WaveBand::all,
          2.9,
          {1.398, .209, 1.271, .246, 0.732, .112, 1.268, .243, 1.247, .220, 1.138, .114, 1.026, .021}},
      Row{'A',
          WaveBand::resolved,
          2.9,
          {1.354, .189, 1.219, .215, 0.753, .105, 1.217, .213, 1.199, .193, 1.111, .103, 1.021, .019}},
      Row{'B',
          WaveBand::all,
          2.5,
          {1.093, .080, 1.090, .055, 0.920, .066, 1.090, .055, 1.084, .051, 1.051, .030, 1.010, .006}},
      Row{'B',
          WaveBand::all,
          2.9,
          {1.146, .138, 1.159, .100, 0.885, .109, 1.158, .099, 1.147, .092, 1.089, .054, 1.018, .011}},
      Row{'B',
          WaveBand::resolved,
          2.9,
          {1.135, .135, 1.133, .081, 0.893, .106, 1.132, .080, 1.123, .074, 1.075, .044, 1.015, .009}},
  };
  const double width = 3 * std::sqrt(1.0 / 20 + 1.0 / 150);
  for (const Row& row : rows)
    for (std::size_t q = 0; q < 7; ++q) {
      auto quantity = [&](double D, int seed) {
        const State st = pressed(row.preset, D, seed, 0.01, Scaling::peak_to_valley, row.band);
        if (q < 3) return std::array{depth_of, area_of, secant_of}[q](st);
        return mu_of(st, ratios[q - 3], Cap::none);
      };
      const auto found = over_seeds([&](int seed) { return quantity(row.D, seed) / quantity(2.0, seed); });
      EXPECT_NEAR(found.mean, row.expected[2 * q], width * row.expected[2 * q + 1] + 0.0005)
          << row.preset << " D = " << row.D << " quantity " << q;
    }
}

TEST(PaperTables, TrendsWithDimension) {
  for (const char preset : {'A', 'B'}) {
    double depth = 0, area = 0, spots = 0, secant = 1;
    std::array<std::array<double, 4>, 2> mu{};
    for (int k = 0; k < 10; ++k) {
      const double D = decade(k);
      const std::string what = std::string(1, preset) + " D = " + std::to_string(D);
      const double new_depth = statistics(preset, D, depth_of).mean;
      const double new_area = statistics(preset, D, area_of).mean;
      const double new_spots = statistics(preset, D, spots_of).mean;
      const double new_secant = statistics(preset, D, secant_of).mean;
      EXPECT_GT(new_depth, depth) << what;
      EXPECT_GT(new_area, area) << what;
      EXPECT_GT(new_spots, spots) << what;
      EXPECT_LT(new_secant, secant) << what;
      std::tie(depth, area, spots, secant) = std::tuple{new_depth, new_area, new_spots, new_secant};
      for (int seed = 1; seed <= 20; ++seed) {
        EXPECT_GE(pressed(preset, D, seed).indentation(), 0.20) << what;
        EXPECT_LE(pressed(preset, D, seed).indentation(), 0.50) << what;
      }
      for (const Cap cap : {Cap::none, Cap::yield}) {
        auto& before = mu[cap == Cap::none ? 0 : 1];
        for (std::size_t r = 0; r < 4; ++r) {
          const double ratio =
              ratio_to_two(preset, D, [&](const State& st) { return mu_of(st, ratios[r], cap); }).mean;
          if (cap == Cap::none) {
            EXPECT_GT(ratio, before[r]) << what << " r = " << ratios[r];
          }
          before[r] = ratio;
          if (k > 0 && r > 0) {
            EXPECT_LT(ratio, before[r - 1]) << what << " r = " << ratios[r];
          }
        }
      }
    }
  }
}

TEST(PaperTables, ControlsThatMustFail) {
  for (const char preset : {'A', 'B'}) {
    auto ratio = [&](auto quantity) {
      return over_seeds([&](int seed) { return quantity(2.9, seed) / quantity(2.0, seed); }).mean;
    };
    // Scaled by rms height the area does not rise with D.
    EXPECT_LT(ratio([&](double D, int seed) {
                return pressed(preset, D, seed, 0.01, Scaling::six_sd).area_fraction();
              }),
              1);
    // With raw heights the contact stiffens.
    EXPECT_GT(ratio([&](double D, int seed) {
                return pressed(preset, D, seed, 0.01, Scaling::raw).secant_stiffness();
              }),
              1);
    // The tangent stiffness rises with the area.
    EXPECT_GT(ratio([&](double D, int seed) {
                const State st = pressed(preset, D, seed);
                return st.stiffness() * heights(preset, D, seed).peak_to_valley();
              }),
              1);
    // An absolute cap of 2 τ0 breaks the ordering in r.
    EXPECT_GT(ratio([&](double D, int seed) { return mu_of(pressed(preset, D, seed), 100, Cap::absolute); }),
              ratio([&](double D, int seed) { return mu_of(pressed(preset, D, seed), 10, Cap::absolute); }));
  }
}

}  // namespace
}  // namespace asperity::paper_tables_test
