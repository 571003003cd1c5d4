// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of ISO 21920-2 of a profile without form and waviness; heights about the mean line.
//   evaluation length   Ra Rq Rsk Rku Rt Rdq Rda Rdr Rsm Rc, material ratio curve
//   mean of sections    Rp Rv Rz (Rv may be negative: Rp + Rv = Rz)
//   extremes            Rzx of a sliding section; Rpt, Rvt of any section
// Rsm and Rc: mean width and height of elements between mean-line crossings. Hills above `threshold` · Rp and
// dales below -`threshold` · Rv count; other runs join their neighbours. An element is a hill with the next
// dale, counted from the left and from the right; the incomplete first and last features are left out.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "engine/metrology/parameters/material_ratio.hpp"
#include "engine/surface/profile.hpp"

namespace asperity {

struct ProfileSettings {
  int sections = 5;
  double threshold = 0.1;  // of Rp and Rv, 0 … 1
};

struct SectionedValue {
  double value = 0;
  std::optional<double> u;  // s/√sections over the sections; empty for one
};

struct ProfileParameters {
  SectionedValue Ra, Rq, Rp, Rv, Rz;  // m
  double Rsk = 0, Rku = 0;
  double Rt = 0, Rpt = 0, Rvt = 0, Rzx = 0;  // m
  std::optional<double> Rdq;                 // seven-sample rule
  std::optional<double> Rdq_edges;           // forward differences
  std::optional<double> Rda, Rdr;            // forward differences; Rdr = mean √(1 + slope²) - 1
  std::optional<double> Rsm, Rc;             // m; empty without whole elements
  std::size_t elements = 0;                  // both passes
  CoreOfCurve core;                          // Rk …
  double Rdc = 0;                            // m, c(2.5 %) - c(50 %)
  std::size_t measured = 0;
};

// ISO 21920-3: F subtracts a polynomial, S is the low-pass Nis, L subtracts the low-pass Nic = section
// length. Half a section at both ends is cut; `sections` from the middle remain.
struct ProfilePreparation {
  std::optional<int> F;
  std::optional<double> S;  // m
  double section = 0;       // m
  int sections = 5;
};
struct PreparedProfile {
  Profile profile;
  int sections;  // that fit, at most the requested number
};
// Class Sc1 … Sc5 of ISO 21920-3; empty for other names.
std::optional<ProfilePreparation> setting_class(std::string_view name);

// P parameters: F, then S, with half of S cut at both ends. Throws Error{bad_value} for a closed outline or
// if only rounding is left.
Profile primary_profile(const Profile& trace, const std::optional<int>& F, const std::optional<double>& S);

// Throws Error{bad_value} for a closed outline, sections below ten samples, no whole section, or S not below
// the section.
PreparedProfile prepared_profile(const Profile& trace, const ProfilePreparation& preparation);

// Throws Error{bad_value} for equal heights, under two samples per section, an unmeasured section, or bad
// settings. With holes, Rsm and Rc are empty.
ProfileParameters profile_parameters(const Profile& profile, const ProfileSettings& settings = {});

}  // namespace asperity
