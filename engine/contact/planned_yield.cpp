// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/planned_yield.hpp"

#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

double lower_plastic_share(double lower_hardness, double upper_hardness, double modulus_ratio) {
  if (!std::isfinite(upper_hardness)) return 1;
  if (!std::isfinite(lower_hardness)) return 0;
  // Beyond, one body takes all; the exponential must not overflow.
  constexpr double least = 1e-3, most = 1e3, greatest_exponent = 700;
  const double ratio = std::clamp(lower_hardness / upper_hardness, least, most);
  const double exponent = 1.5 * (ratio * ratio - 1 / (ratio * ratio));
  if (exponent > greatest_exponent) return 0;
  if (exponent < -greatest_exponent) return 1;
  return 1 / (1 + elementary::exp(exponent) * modulus_ratio);
}

MetMemory local_hardness(const ContactGeometry& geometry, const PlannedYield& yield) {
  return met(geometry, geometry.kept(hardness_memory), yield.upper_hardness);
}

YieldLaw yield_law(const PlannedYield& yield, const MetMemory& local, double factor) {
  YieldLaw law;
  if (!std::isfinite(yield.hardness())) return law;
  law.cap = factor * yield.hardness();
  if (!yield.hardens()) return law;
  law.hardening = yield.hardening;
  if (!local.lower && !local.upper) return law;
  Field limit = local.lower ? *local.lower : *local.upper;
  for (std::size_t k = 0; k < limit.size(); ++k)
    limit[k] = factor * std::min(local.lower ? (*local.lower)[k] : yield.lower_hardness,
                                 local.upper ? (*local.upper)[k] : yield.upper_hardness);
  law.yield = std::make_shared<const Field>(std::move(limit));
  return law;
}

YieldedBodies yielded_bodies(const ContactGeometry& geometry, const PlannedYield& yield,
                             const PlasticChange& change) {
  const Grid& grid = geometry.grid();
  const Field& w = change.approach;
  const MetMemory local = local_hardness(geometry, yield);
  const auto lower_share = [&](std::size_t k) {
    return lower_plastic_share(local.lower ? (*local.lower)[k] : yield.lower_hardness,
                               local.upper ? (*local.upper)[k] : yield.upper_hardness, yield.modulus_ratio);
  };

  Field lower = geometry.lower().heights();
  Field upper_loss(grid.nx, grid.ny);
  for (std::size_t k = 0; k < w.size(); ++k) {
    if (!(w[k] > 0)) continue;
    const double share = lower_share(k);
    lower[k] -= share * w[k];
    upper_loss[k] = (1 - share) * w[k];
  }

  YieldedBodies after{Surface(grid, std::move(lower), geometry.lower().traits()), geometry.upper(),
                      geometry.kept(hardness_memory)};
  const auto* rough = std::get_if<Surface>(&geometry.upper());
  if (rough != nullptr && std::isfinite(yield.upper_hardness)) {
    const Pose& pose = geometry.pose();
    Field own_loss = pose.to_upper(upper_loss, grid);
    if (!pose.on_lattice()) {
      const double meant = block_sum(upper_loss.values()), mapped = block_sum(own_loss.values());
      if (meant > 0 && mapped > 0) {
        after.mapped_volume = mapped / meant;
        for (double& loss : own_loss.values()) loss *= meant / mapped;
      }
    }
    Field upper = rough->heights();
    for (std::size_t k = 0; k < upper.size(); ++k)
      if (own_loss[k] > 0) upper[k] -= own_loss[k];
    after.upper = Surface(rough->grid(), std::move(upper), rough->traits());
  }
  if (!change.hardness.empty()) {
    const auto at_first = [](double hardness) {
      return std::isfinite(hardness) ? std::optional(hardness) : std::nullopt;
    };
    after.hardness = raised(geometry, after.hardness, change.hardness, at_first(yield.lower_hardness),
                            at_first(yield.upper_hardness));
  }
  return after;
}

}  // namespace asperity
