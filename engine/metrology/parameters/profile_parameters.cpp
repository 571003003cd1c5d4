// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/profile_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/require.hpp"
#include "engine/metrology/gaussian_filter.hpp"
#include "engine/metrology/levelling.hpp"

namespace asperity {

namespace {

// Ignores NaN.
struct Mean {
  double sum = 0;
  std::size_t count = 0;
  void add(double value) {
    if (std::isnan(value)) return;
    sum += value;
    ++count;
  }
  std::optional<double> value() const {
    if (count == 0) return {};
    return sum / static_cast<double>(count);
  }
};

template <class Before>
class MovingExtreme {
 public:
  MovingExtreme(std::span<const double> v, std::size_t width) : v_(v), width_(width) {}
  void step_to(std::size_t k) {
    if (!std::isnan(v_[k])) {
      while (!places_.empty() && !Before()(v_[places_.back()], v_[k])) places_.pop_back();
      places_.push_back(k);
    }
    while (!places_.empty() && places_.front() + width_ <= k) places_.pop_front();
  }
  bool empty() const { return places_.empty(); }
  double value() const { return v_[places_.front()]; }

 private:
  std::span<const double> v_;
  std::size_t width_;
  std::deque<std::size_t> places_;
};

double greatest_height_in_a_section(std::span<const double> v, std::size_t width) {
  MovingExtreme<std::greater<>> high(v, width);
  MovingExtreme<std::less<>> low(v, width);
  double greatest = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    high.step_to(k);
    low.step_to(k);
    if (k + 1 >= width && !high.empty()) greatest = std::max(greatest, high.value() - low.value());
  }
  return greatest;
}

struct Feature {
  bool hill = false;
  std::size_t last = 0;  // last sample
  double extreme = 0;    // m, greatest distance from the mean line
};

// Alternating hills above `high` and dales below -`low`.
std::vector<Feature> features(std::span<const double> v, double high, double low) {
  std::vector<Feature> found;
  for (std::size_t first = 0; first < v.size();) {
    const bool hill = v[first] > 0;
    std::size_t last = first;
    double extreme = std::abs(v[first]);
    while (last + 1 < v.size() && (v[last + 1] > 0) == hill) extreme = std::max(extreme, std::abs(v[++last]));
    if (extreme > (hill ? high : low)) {
      if (!found.empty() && found.back().hill == hill) {
        found.back().last = last;
        found.back().extreme = std::max(found.back().extreme, extreme);
      } else {
        found.push_back({hill, last, extreme});
      }
    }
    first = last + 1;
  }
  return found;
}

struct Elements {
  Mean width, height;
  // Adds features `left` and `left + 1`, between the crossings at their ends.
  void add(const std::vector<Feature>& f, const std::vector<double>& ends, std::size_t left) {
    width.add(ends[left + 1] - ends[left - 1]);
    height.add(f[left].extreme + f[left + 1].extreme);
  }
};

Elements elements_of(std::span<const double> v, double high, double low) {
  Elements elements;
  const std::vector<Feature> f = features(v, high, low);
  if (f.size() < 4) return elements;
  std::vector<double> ends;  // crossing after each feature, in samples
  for (std::size_t k = 0; k + 1 < f.size(); ++k) {
    const double a = v[f[k].last], b = v[f[k].last + 1];
    ends.push_back(static_cast<double>(f[k].last) + a / (a - b));
  }
  const std::size_t first = 1, last = f.size() - 2;
  for (std::size_t k = first; k + 1 <= last; k += 2) elements.add(f, ends, k);
  for (std::size_t k = last; k >= first + 1; k -= 2) elements.add(f, ends, k - 1);
  return elements;
}

// Mean over sections, and its standard uncertainty.
template <class Of>
SectionedValue over_sections(int sections, const Of& of) {
  double sum = 0;
  Array<double> values;
  for (int k = 0; k < sections; ++k) values.push_back(of(k)), sum += values.back();
  SectionedValue result{sum / sections, {}};
  if (sections < 2) return result;
  double squares = 0;
  for (const double value : values) squares += (value - result.value) * (value - result.value);
  result.u = std::sqrt(squares / (sections - 1) / sections);
  return result;
}

void refuse_rounding(const Profile& trace, std::span<const double> left, const std::string& once) {
  const Range before = trace.height_range();
  const double span = known_range(left).span();
  constexpr double last_places = 1024 * std::numeric_limits<double>::epsilon();
  if (span > 0 && span <= last_places * std::max(std::abs(before.min), std::abs(before.max)))
    refuse("nothing but rounding is left of the trace once " + once,
           "its parameters need heights that differ");
}

struct Moments {
  double abs = 0, square = 0;  // about the mean line, or the section's own
  double high = 0, low = 0;    // from the mean line
};

Moments moments_of(std::span<const double> v, std::size_t first, std::size_t last, bool about_its_own) {
  Mean own, abs, square;
  for (std::size_t k = first; about_its_own && k < last; ++k) own.add(v[k]);
  const double line = own.value().value_or(0);
  Moments m{0, 0, -INFINITY, INFINITY};
  for (std::size_t k = first; k < last; ++k) {
    abs.add(std::abs(v[k] - line));
    square.add((v[k] - line) * (v[k] - line));
    if (v[k] > m.high) m.high = v[k];
    if (v[k] < m.low) m.low = v[k];
  }
  if (abs.count == 0)
    refuse("no sample of the profile was measured from sample " + std::to_string(first) + " to " +
               std::to_string(last - 1),
           "its sections need measured samples each");
  m.abs = *abs.value();
  m.square = *square.value();
  return m;
}

void take_skewness_and_kurtosis(std::span<const double> v, ProfileParameters& result) {
  Mean third, fourth;
  for (const double h : v) {
    const double u = h / result.Rq.value;
    third.add(u * u * u);
    fourth.add(u * u * u * u);
  }
  result.Rsk = *third.value();
  result.Rku = *fourth.value();
}

void take_slopes(std::span<const double> v, double h, ProfileParameters& result) {
  Mean edge_squares, edge_slopes, edge_lengths, seven_squares;
  for (std::size_t k = 0; k + 1 < v.size(); ++k) {
    const double slope = (v[k + 1] - v[k]) / h;
    edge_squares.add(slope * slope);
    edge_slopes.add(std::abs(slope));
    edge_lengths.add(slope * slope / (1 + std::sqrt(1 + slope * slope)));
  }
  for (std::size_t k = 3; k + 3 < v.size(); ++k) {
    const double slope =
        (45 * (v[k + 1] - v[k - 1]) - 9 * (v[k + 2] - v[k - 2]) + (v[k + 3] - v[k - 3])) / (60 * h);
    seven_squares.add(slope * slope + 0 * v[k]);  // NaN if the middle is missing
  }
  const auto root = [](std::optional<double> square) { return square ? std::sqrt(*square) : square; };
  result.Rdq = root(seven_squares.value());
  result.Rdq_edges = root(edge_squares.value());
  result.Rda = edge_slopes.value();
  result.Rdr = edge_lengths.value();
}

}  // namespace

std::optional<ProfilePreparation> setting_class(std::string_view name) {
  // Rz limits (µm): 0.16, 0.8, 16, 80; sections (mm): 0.08, 0.25, 0.8, 2.5, 8.
  struct Class {
    std::string_view name;
    double S, section;
  };
  static constexpr Class classes[] = {{"Sc1", 2.5e-6, 0.08e-3},
                                      {"Sc2", 2.5e-6, 0.25e-3},
                                      {"Sc3", 2.5e-6, 0.8e-3},
                                      {"Sc4", 8e-6, 2.5e-3},
                                      {"Sc5", 25e-6, 8e-3}};
  for (const Class& c : classes)
    if (c.name == name) {
      ProfilePreparation preparation;
      preparation.S = c.S;
      preparation.section = c.section;
      return preparation;
    }
  return {};
}

Profile primary_profile(const Profile& trace, const std::optional<int>& F, const std::optional<double>& S) {
  if (trace.closed()) refuse("a closed outline has no primary profile", "give a profile along a line");
  if (S) require_positive("S", *S, "m");
  const double h = trace.spacing();
  const auto n = static_cast<std::size_t>(trace.size());
  if (n < 2)
    refuse("a profile of " + std::to_string(n) + " sample has no parameters", "give a longer profile");
  const double cut = S ? std::ceil(*S / h / 2) : 0;
  if (2 * cut + 2 > static_cast<double>(n))
    refuse("nothing is left of the trace of " + metres(trace.length()) + " once half of `S`, " + metres(*S) +
               ", is cut off at either end",
           "give a longer trace or a smaller `S`");
  Profile profile = trace;
  if (F) profile = levelled(profile, *F);
  if (S) profile = gaussian_filtered(profile, {.short_wave = S, .long_wave = {}});
  const auto first = static_cast<std::size_t>(cut);
  const std::span<const double> z = profile.measured_heights().subspan(first, n - 2 * first);
  refuse_rounding(trace, z, "its form is taken away");
  return Profile::with_holes(h, Array<double>(z.begin(), z.end()));
}

PreparedProfile prepared_profile(const Profile& trace, const ProfilePreparation& preparation) {
  require_positive("section", preparation.section, "m");
  require(preparation.sections >= 1, "sections", preparation.sections, "",
          "give the number of sections, 1 or more");
  if (trace.closed()) refuse("a closed outline has no sections", "give a profile along a line");
  if (preparation.S && !(*preparation.S < preparation.section))
    refuse("the nesting index `S`, " + metres(*preparation.S) + ", is not below the `section`, " +
               metres(preparation.section),
           "give a smaller `S` or a longer `section`");
  const double h = trace.spacing(), samples = preparation.section / h;
  if (samples < 10)
    refuse(
        "a `section` of " + metres(preparation.section) + " has under ten samples, " + metres(h) + " apart",
        "give a longer `section`");
  const auto half = static_cast<std::size_t>(std::round(samples / 2));
  const auto n = static_cast<std::size_t>(trace.size());
  const double whole = n > 2 * half ? std::floor(static_cast<double>(n - 2 * half) / samples + 1e-6) : 0;
  if (whole < 1)
    refuse("the trace of " + metres(trace.length()) + " holds no section of " + metres(preparation.section) +
               " once half a section is cut off at either end",
           "give a longer trace or a shorter `section`");
  const int sections = static_cast<int>(std::min<double>(preparation.sections, whole));
  Profile profile = trace;
  if (preparation.F) profile = levelled(profile, *preparation.F);
  if (preparation.S) profile = gaussian_filtered(profile, {.short_wave = preparation.S, .long_wave = {}});
  profile = gaussian_filtered(profile, {.short_wave = {}, .long_wave = preparation.section});
  const auto length = std::min(n - 2 * half, static_cast<std::size_t>(std::round(sections * samples)));
  const std::size_t first = half + (n - 2 * half - length) / 2;
  const std::span<const double> z = profile.measured_heights().subspan(first, length);
  refuse_rounding(trace, z, "form and waves longer than " + metres(preparation.section) + " are taken away");
  return {Profile::with_holes(h, Array<double>(z.begin(), z.end())), sections};
}

ProfileParameters profile_parameters(const Profile& profile, const ProfileSettings& settings) {
  require(settings.sections >= 1, "sections", settings.sections, "",
          "give the number of sections, 1 or more");
  require(settings.threshold >= 0 && settings.threshold <= 1, "threshold", settings.threshold, "",
          "give the share of Rp and Rv under which hills and dales do not count, from 0 to 1");
  const std::span<const double> z = profile.measured_heights();
  const auto n = z.size();
  const auto sections = static_cast<std::size_t>(settings.sections);
  if (n < 2 * sections)
    refuse("a profile of " + std::to_string(n) + " samples has no " + std::to_string(sections) + " sections",
           "give a longer profile or fewer `sections`");
  const Range r = profile.height_range();
  if (r.span() == 0)
    refuse("all heights of the profile are equal", "its parameters need heights that differ");

  ProfileParameters result;
  result.measured = profile.measured();
  const MaterialRatioCurve curve(z);
  result.core = curve.core();
  result.Rdc = curve.height_difference(0.025, 0.5);

  Array<double> v(z.begin(), z.end());
  for (double& h : v) h -= curve.mean();
  std::vector<Moments> of_section;
  for (std::size_t k = 0; k < sections; ++k)
    of_section.push_back(moments_of(v, n * k / sections, n * (k + 1) / sections, true));
  const auto each = [&](auto of) {
    return over_sections(settings.sections,
                         [&](int k) { return of(of_section[static_cast<std::size_t>(k)]); });
  };
  result.Rp = each([](const Moments& m) { return m.high; });
  result.Rv = each([](const Moments& m) { return -m.low; });
  result.Rz = each([](const Moments& m) { return m.high - m.low; });
  result.Ra = each([](const Moments& m) { return m.abs; });
  result.Rq = each([](const Moments& m) { return std::sqrt(m.square); });
  const Moments all = moments_of(v, 0, n, false);
  result.Ra.value = all.abs;
  result.Rq.value = std::sqrt(all.square);
  take_skewness_and_kurtosis(v, result);
  result.Rt = r.span();
  result.Rpt = std::ranges::max_element(of_section, {}, &Moments::high)->high;
  result.Rvt = -std::ranges::min_element(of_section, {}, &Moments::low)->low;
  result.Rzx = greatest_height_in_a_section(v, n / sections);

  take_slopes(v, profile.spacing(), result);
  if (profile.complete()) {
    const Elements elements =
        elements_of(v, settings.threshold * result.Rp.value, settings.threshold * result.Rv.value);
    result.elements = elements.width.count;
    if (const auto width = elements.width.value()) result.Rsm = *width * profile.spacing();
    result.Rc = elements.height.value();
  }
  return result;
}

}  // namespace asperity
