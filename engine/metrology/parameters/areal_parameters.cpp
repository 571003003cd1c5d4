// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/areal_parameters.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <mutex>
#include <utility>

#include "engine/core/digest.hpp"
#include "engine/core/error.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/gaussian_filter.hpp"
#include "engine/metrology/levelling.hpp"

namespace asperity {

namespace {

// Computed on first use; after an exception, the next use tries again.
template <class T>
class MadeOnce {
 public:
  template <class Make>
  const T& get(std::atomic<int>& count, const Make& make) {
    std::call_once(once_, [&] {
      value_.emplace(make());
      ++count;
    });
    return *value_;
  }

 private:
  std::once_flag once_;
  std::optional<T> value_;
};

Surface prepared_map(const Surface& surface, const ArealPreparation& preparation) {
  Surface result = surface;
  if (preparation.F) result = levelled(result, *preparation.F);
  if (preparation.S) result = gaussian_filtered(result, {.short_wave = preparation.S, .long_wave = {}});
  if (preparation.L) result = gaussian_filtered(result, {.short_wave = {}, .long_wave = preparation.L});
  return result;
}

// Subtracting a plane leaves a few units in the last place of the original heights.
bool rounding_alone(const Surface& before, const Surface& after, const ArealPreparation& preparation) {
  if (!preparation.F && !preparation.S && !preparation.L) return after.peak_to_valley() == 0;
  const Range r = before.height_range();
  constexpr double last_places = 1024 * std::numeric_limits<double>::epsilon();
  return after.peak_to_valley() <= last_places * std::max(std::abs(r.min), std::abs(r.max));
}

}  // namespace

struct ArealParameters::Groups {
  Surface map;
  ArealPreparation preparation;
  bool flat;
  std::atomic<int> computed = 0;
  MadeOnce<Roughness> heights;
  MadeOnce<ArealSlopes> slopes;
  MadeOnce<MaterialRatioCurve> curve;
  MadeOnce<CoreOfCurve> core;
  MadeOnce<VolumesOfCurve> volumes;
  MadeOnce<Hills> hills;
  MadeOnce<std::optional<TextureAspect>> texture;
  MadeOnce<std::optional<TextureDirection>> direction;
  MadeOnce<ArealUncertainty> uncertainty;

  Groups(Surface m, const Surface& before, ArealPreparation p)
      : map(std::move(m)), preparation(p), flat(rounding_alone(before, map, p)) {}
};

ArealParameters::ArealParameters(const Surface& surface, const ArealPreparation& preparation) {
  require_positive("S", preparation.S, "m");
  require_positive("L", preparation.L, "m");
  if (preparation.S && preparation.L && !(*preparation.S < *preparation.L))
    refuse(
        "the nesting index `S`, " + metres(*preparation.S) + ", is not below `L`, " + metres(*preparation.L),
        "waves between the two are kept, so `S` must be the smaller");
  require(preparation.pruning >= 0 && preparation.pruning <= 1, "pruning", preparation.pruning, "",
          "give the share of Sz that a hill must rise, from 0 to 1");
  groups_ = std::make_shared<Groups>(prepared_map(surface, preparation), surface, preparation);
}

const Surface& ArealParameters::prepared() const { return groups_->map; }
const ArealPreparation& ArealParameters::preparation() const { return groups_->preparation; }
bool ArealParameters::flat() const { return groups_->flat; }
bool ArealParameters::has_inside() const { return prepared().grid().nx > 2 && prepared().grid().ny > 2; }

std::string ArealParameters::how() const {
  const ArealPreparation& p = preparation();
  std::string text;
  if (p.F) text += "F-operation of degree " + std::to_string(*p.F) + ", ";
  if (p.S) text += "S-filter " + metres(*p.S) + ", ";
  if (p.L) text += "L-filter " + metres(*p.L) + ", ";
  return text + "mean removed";
}

const Roughness& ArealParameters::heights() const {
  return groups_->heights.get(groups_->computed, [&] { return roughness(prepared()); });
}
const ArealSlopes& ArealParameters::slopes() const {
  return groups_->slopes.get(groups_->computed, [&] { return areal_slopes(prepared()); });
}
const MaterialRatioCurve& ArealParameters::curve() const {
  return groups_->curve.get(groups_->computed,
                            [&] { return MaterialRatioCurve(prepared().measured_heights().values()); });
}
const CoreOfCurve& ArealParameters::core() const {
  return groups_->core.get(groups_->computed, [&] { return curve().core(); });
}
const VolumesOfCurve& ArealParameters::volumes() const {
  return groups_->volumes.get(groups_->computed, [&] { return curve().volumes(); });
}
const Hills& ArealParameters::hills() const {
  return groups_->hills.get(groups_->computed,
                            [&] { return asperity::hills(prepared(), preparation().pruning); });
}
const std::optional<TextureAspect>& ArealParameters::texture() const {
  return groups_->texture.get(groups_->computed, [&]() -> std::optional<TextureAspect> {
    const Grid& grid = prepared().grid();
    if (flat() || grid.nx < 2 || grid.ny < 2) return {};
    return Autocorrelation(prepared()).texture();
  });
}
const std::optional<TextureDirection>& ArealParameters::direction() const {
  return groups_->direction.get(groups_->computed, [&]() -> std::optional<TextureDirection> {
    if (flat()) return {};
    try {
      return texture_direction(prepared());
    } catch (const Error& error) {
      if (error.code() != ErrorCode::bad_value) throw;
      return {};
    }
  });
}
const ArealUncertainty& ArealParameters::uncertainty() const {
  return groups_->uncertainty.get(groups_->computed, [&] {
    return areal_uncertainty(prepared(), texture() ? texture()->Sal : std::nullopt);
  });
}

std::string ArealParameters::why_not(const std::string& parameter) const {
  const auto one_of = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return parameter == name; });
  };
  const std::string equal = prepared().peak_to_valley() == 0
                                ? "all heights are equal"
                                : "all heights are equal but for rounding of the map that was prepared";
  if (one_of({"Ssk", "Sku", "Smr1", "Smr2", "Sk_window", "Spd", "Svd", "Spc", "S5p", "S5v", "S10z"}) &&
      flat())
    return equal;
  if (parameter == "Sdq" && !slopes().Sdq) return "no two neighbouring points were measured";
  if (parameter == "Sdq_seven" && !slopes().Sdq_seven)
    return "nowhere were a point and three neighbours each way along both axes measured";
  if (parameter == "Sdr" && !slopes().Sdr) return "no cell has four measured corners";
  if (parameter.starts_with("u_")) {
    const ArealUncertainty& u = uncertainty();
    if (!u.why_not.empty()) return u.why_not;
    const std::pair<const char*, const std::optional<double>&> all[] = {{"u_Sa", u.Sa},   {"u_Sq", u.Sq},
                                                                        {"u_Ssk", u.Ssk}, {"u_Sku", u.Sku},
                                                                        {"u_Sdq", u.Sdq}, {"u_Sdr", u.Sdr}};
    for (const auto& [name, value] : all)
      if (parameter == name && !value) return "one of sixteen tiles does not define it";
  }
  if (one_of({"Sal", "Str", "Str_bound"})) {
    if (!texture()) return flat() ? equal : "the map is one node wide";
    if (parameter == "Sal" && !texture()->Sal)
      return "along no direction does the autocorrelation fall to 0.2 within half the map";
    if (parameter == "Str" && !texture()->Str)
      return "along some direction the autocorrelation does not fall to 0.2 within half the map; Str is "
             "below Str_bound";
    if (parameter == "Str_bound" && !texture()->Str_bound) return "Str itself is defined";
  }
  if (one_of({"Std", "Std_wave"}) && !direction())
    return flat() ? equal
                  : "the map is under six cells wide, or no wave is between two cells and two thirds of the "
                    "map long";
  if (one_of({"Spd", "Svd", "Spc", "S5p", "S5v", "S10z"}) && !has_inside())
    return "the map is under three nodes wide, and all of them are at its rim";
  if (parameter == "Spc" && !hills().Spc) return "no peak is left after pruning";
  if (parameter == "S5p" && !hills().S5p) return "fewer than five peaks are left after pruning";
  if (parameter == "S5v" && !hills().S5v) return "fewer than five pits are left after pruning";
  if (parameter == "S10z" && !hills().S10z)
    return "fewer than five peaks or five pits are left after pruning";
  return "";
}

int ArealParameters::groups_computed() const { return groups_->computed; }

std::string ArealParameters::digest() const {
  Digester digester;
  digester.add("areal parameters").add(prepared().digest()).add(how()).add(preparation().pruning);
  return digester.hex();
}

}  // namespace asperity
