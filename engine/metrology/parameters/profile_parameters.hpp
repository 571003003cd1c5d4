// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters of a profile, ISO 21920-2, of a profile whose form and waviness were removed before: nothing
// is levelled or filtered here. Heights v count from the mean line of the whole evaluation length.
//   over the evaluation length   Ra Rq Rsk Rku Rt Rdq Rda Rdr Rsm Rc and the material ratio curve (Rk, Rpk,
//   …) means over the sections      Rp Rv Rz; Rzx is the greatest height in a section moved sample by sample,
//   Rpt and Rvt the
//                                greatest height and depth of any
// A section is not levelled again: the depth of one that lies wholly above the mean line is negative, so that
// Rp + Rv = Rz.
//
// Rsm and Rc go by crossings of the mean line: runs of one sign; a hill counts where its summit is above
// `threshold` of Rp, a dale where it is below `threshold` of Rv; runs that do not count join their
// neighbours; the first and last of what remains are incomplete and left out; a hill and the dale beside it
// are an element, paired once from the left and once from the right. Rsm is the mean width of the elements,
// Rc the mean of their heights.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "engine/metrology/parameters/material_ratio.hpp"
#include "engine/surface/profile.hpp"

namespace asperity {

struct ProfileSettings {
  int sections = 5;
  double threshold = 0.1;  // of Rp for hills and of Rv for dales, 0 … 1
};

// A value over the evaluation length or a mean over the sections, with what the sections say of its
// uncertainty.
struct SectionedValue {
  double value = 0;
  std::optional<double> u;  // standard deviation of the sections' values/√sections; none under two sections
};

struct ProfileParameters {
  SectionedValue Ra, Rq, Rp, Rv, Rz;  // m
  double Rsk = 0, Rku = 0;
  double Rt = 0, Rpt = 0, Rvt = 0, Rzx = 0;  // m
  std::optional<double> Rdq;                 // the rule of seven samples, three dropped at each end
  std::optional<double> Rdq_edges;           // forward differences
  std::optional<double> Rda, Rdr;            // forward differences; Rdr = mean √(1 + slope²) - 1
  std::optional<double> Rsm, Rc;             // m; none where no element is whole
  std::size_t elements = 0;                  // of both passes
  CoreOfCurve core;                          // Rk … with R for S
  double Rdc = 0;                            // m, c(2.5 %) - c(50 %)
  std::size_t measured = 0;
};

// What ISO 21920-3 has done to a primary trace before: F, the polynomial taken away; S, the low-pass of the
// nesting index Nis; L, less the low-pass of the nesting index Nic, which is also the length of a section.
// Half a section is then cut off at either end, where the filter feels the rim, and `sections` sections are
// taken from the middle.
struct ProfilePreparation {
  std::optional<int> F;
  std::optional<double> S;  // m
  double section = 0;       // m
  int sections = 5;
};
struct PreparedProfile {
  Profile profile;
  int sections;  // as many of those asked for as the trace holds
};
// The class Sc1 … Sc5 of ISO 21920-3 by its name: `S` and `section`. Nothing where there is no such class.
std::optional<ProfilePreparation> setting_class(std::string_view name);

// Of which the P parameters are: F, then S, and no L-filter; the waviness stays. Where S is given, half of it
// is cut off at either end; else the whole length is evaluated. A closed outline is refused, and a trace of
// which nothing, or nothing but rounding, is left: Error{bad_value}.
Profile primary_profile(const Profile& trace, const std::optional<int>& F, const std::optional<double>& S);

// A closed outline is refused; so are sections under ten samples, a trace that holds no section once its ends
// are cut, and S not below the section: Error{bad_value}.
PreparedProfile prepared_profile(const Profile& trace, const ProfilePreparation& preparation);

// Throws Error{bad_value} for a profile of equal heights, for fewer than two samples a section, for a section
// without any measured, and for settings outside their ranges. Differences count where their samples were
// measured; crossings need every sample, so that Rsm and Rc of a profile with holes are none.
ProfileParameters profile_parameters(const Profile& profile, const ProfileSettings& settings = {});

}  // namespace asperity
