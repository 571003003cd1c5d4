// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/friction/partial_slip.hpp"

#include <array>

#include "engine/contact/effects/tangential.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

const std::array<std::string, 2> names_of_fields = {"shear", "stick"};

// Q/(f P), at most 1 up to rounding.
double ratio_of(const ShearRequest& request, double load) {
  require_positive("friction", request.friction, "", "give a finite coefficient above zero");
  if (request.force.has_value() == request.ratio.has_value())
    refuse(std::string("`force` and `ratio` are ") + (request.force ? "both" : "not") + " given",
           "give one of the two");
  if (request.ratio) {
    require(*request.ratio >= 0 && *request.ratio <= 1, "ratio", *request.ratio, "",
            "it is the shear force over the one that slides: give a number from 0 to 1");
    return *request.ratio;
  }
  require(*request.force >= 0 && std::isfinite(*request.force), "force", *request.force, "N",
          "give a finite force from zero up");
  constexpr double rounding = 1e-12;
  const double sliding = request.friction * load, ratio = *request.force / sliding;
  if (!(ratio <= 1 + rounding))
    refuse_infeasible("`force` is " + format_quantity(*request.force, dimension::force) +
                          ", but the contact slides at " + format_quantity(sliding, dimension::force) +
                          ", friction times load",
                      "give less, or a `ratio` from 0 to 1");
  return std::min(1.0, ratio);
}

}  // namespace

bool has_tangential(const Effects& effects) { return effects.has<TangentialOptions>(); }

void require_tangential(const Effects& effects) {
  if (!has_tangential(effects))
    refuse_without("partial slip", "`tangential`", "name tangential={} in the effects of the contact");
}

PartialSlip shear(const Solver& contact, const State& normal, const ShearRequest& request, Monitor& monitor) {
  require_tangential(normal.effects());
  if (!(normal.load() > 0))
    refuse_state("the contact carries no load, so nothing resists shear", "press it first");
  const double ratio = ratio_of(request, normal.load());
  PartialSlip result(normal, request.friction, ratio,
                     *normal.effects().find<TangentialOptions>()->compliance_ratio);
  if (ratio == 0)
    result.stuck_ = normal;
  else if (const double rest = normal.load() * (1 - ratio); rest > 0) {
    result.stuck_ = contact.press({PressBy::load, rest, {}}, monitor);
    result.cost_ = {result.stuck_->cost().total, {{"tangential", result.stuck_->cost().total}}};
  }
  return result;
}

double PartialSlip::stick_fraction() const {
  return static_cast<double>(stick_contacts()) / static_cast<double>(normal_.contacts());
}

double PartialSlip::displacement() const {
  const double left = stuck_ ? stuck_->approach() : 0;
  return compliance_ratio_ * friction_ * (normal_.approach() - left);
}

double PartialSlip::stiffness() const { return stuck_ ? stuck_->stiffness() / compliance_ratio_ : 0; }

Field PartialSlip::field(std::string_view name) const {
  if (std::find(names_of_fields.begin(), names_of_fields.end(), name) == names_of_fields.end())
    refuse_name("a shear has no field " + quoted(name) + did_you_mean(name, names_of_fields),
                "fields are " + joined(names_of_fields, " and "));
  const Grid& grid = normal_.geometry().grid();
  if (name == "stick") return stuck_ ? *stuck_->field("contact") : Field(grid.nx, grid.ny);
  Field shear = *normal_.field("pressure");
  const std::shared_ptr<const Field> left = stuck_ ? stuck_->field("pressure") : nullptr;
  for (std::size_t k = 0; k < shear.size(); ++k) shear[k] = friction_ * (shear[k] - (left ? (*left)[k] : 0));
  return shear;
}

std::string PartialSlip::text() const {
  return "shear by " + format_quantity(force(), dimension::force) + " of " +
         format_quantity(friction_ * load(), dimension::force) + ", " +
         (slides() ? std::string("all of the contact slips")
                   : format_short(100 * slip_fraction(), 3) + " % of the contact slips") +
         ", shifted by " + format_quantity(displacement(), dimension::length);
}

}  // namespace asperity
