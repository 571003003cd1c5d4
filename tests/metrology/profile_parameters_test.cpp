// SPDX-License-Identifier: GPL-3.0-or-later
// Gauges on which two independent programs agree, and an optional measured trace (ASPERITY_MEASURED).
#include "engine/metrology/parameters/profile_parameters.hpp"
#include "engine/core/files/source_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "engine/core/error.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/surface/io/read.hpp"

namespace asperity::profile_parameters_test {
namespace {

using std::numbers::pi;

void expect_near(double value, double wanted, double relative, const char* name) {
  EXPECT_NEAR(value, wanted, relative * std::abs(wanted) + 1e-12) << name;
}

Profile sine(double wiggle) {
  Array<double> z(5000);
  for (int i = 0; i < 5000; ++i)
    z[static_cast<std::size_t>(i)] =
        std::sin(2 * pi * i / 100 + .3) + wiggle * std::sin(14 * pi * i / 100 + .3);
  return Profile(.1, std::move(z));
}

TEST(ProfileParameters, OfASine) {
  const ProfileParameters p = profile_parameters(sine(0));
  expect_near(p.Ra.value, 0.63662970069, 1e-9, "Ra");
  expect_near(p.Rq.value, std::sqrt(.5), 1e-9, "Rq");
  expect_near(p.Rz.value, 1.99979951855, 1e-9, "Rz");
  expect_near(p.Rt, 1.99979951855, 1e-9, "Rt");
  expect_near(p.Rzx, 1.99979951855, 1e-9, "Rzx");
  expect_near(p.Rc.value(), 1.99979951855, 1e-9, "Rc");
  expect_near(p.Rsm.value(), 10, 1e-9, "Rsm");
  expect_near(p.Rdq.value(), 0.444064178453, 1e-9, "Rdq");
  expect_near(p.Rdr.value(), 0.0923396050392, 1e-9, "Rdr");
  EXPECT_NEAR(p.Rsk, 0, 1e-12);
  expect_near(p.Rku, 1.5, 1e-9, "Rku");
  expect_near(p.core.Sk, 1.77412938228, 1e-9, "Rk");
}

TEST(ProfileParameters, ASmallWaveDoesNotPartElements) {
  const ProfileParameters p = profile_parameters(sine(.05));
  expect_near(p.Rsm.value(), 10, 1e-9, "Rsm");
  expect_near(p.Ra.value, 0.636175164748, 1e-9, "Ra");
  expect_near(p.Rz.value, 2.07397091596, 1e-9, "Rz");
  expect_near(p.Rc.value(), 2.07397091596, 1e-9, "Rc");
  expect_near(p.Rdq.value(), 0.470244754812, 1e-9, "Rdq");
  expect_near(p.Rdr.value(), 0.101608618848, 1e-9, "Rdr");
  expect_near(p.Rku, 1.50746264016, 1e-9, "Rku");
  expect_near(p.core.Sk, 1.79358229015, 1e-9, "Rk");
}

TEST(ProfileParameters, WhatIsNotDefinedIsNoNumber) {
  Array<double> ramp(100);
  for (std::size_t k = 0; k < 100; ++k) ramp[k] = static_cast<double>(k);
  const ProfileParameters p = profile_parameters(Profile(1, ramp));
  EXPECT_FALSE(p.Rsm);  // both incomplete
  EXPECT_FALSE(p.Rc);
  EXPECT_EQ(p.Rdq.value(), 1);
  EXPECT_LT(p.Rv.value, 20);  // upper sections have negative depths
  EXPECT_NEAR(p.Rp.value + p.Rv.value, p.Rz.value, 1e-12);
  EXPECT_THROW(profile_parameters(Profile(1, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1})), Error);
  EXPECT_THROW(profile_parameters(Profile(1, {1, 2, 1, 2})), Error);
  EXPECT_THROW(profile_parameters(sine(0), {.sections = 0}), Error);
}

TEST(ProfileParameters, SectionsAreTakenFromTheMiddleOnceTheEndsAreCut) {
  const PreparedProfile prepared = prepared_profile(sine(0), {.F = 1, .S = .5, .section = 50, .sections = 5});
  EXPECT_EQ(prepared.sections, 5);
  EXPECT_EQ(prepared.profile.size(), 2500);
  // Half a section is 25 m; the middle 250 m of the remaining 450 m.
  EXPECT_NEAR(profile_parameters(prepared.profile).Rsm.value(), 10, 1e-6);
  EXPECT_EQ(prepared_profile(sine(0), {.F = {}, .S = {}, .section = 150, .sections = 5}).sections, 2);
  EXPECT_THROW(prepared_profile(sine(0), {.F = {}, .S = {}, .section = 260}), Error);
  EXPECT_THROW(prepared_profile(sine(0), {.F = {}, .S = {}, .section = .9}), Error);
  EXPECT_THROW(prepared_profile(sine(0), {.F = {}, .S = 60.0, .section = 50}), Error);
  EXPECT_EQ(setting_class("Sc3")->section, .8e-3);
  EXPECT_FALSE(setting_class("Sc6"));
}

TEST(ProfileParameters, OfThePrimaryProfileAreOfTheWholeLength) {
  Array<double> z(5000);
  for (int i = 0; i < 5000; ++i)
    z[static_cast<std::size_t>(i)] = std::sin(2 * pi * i / 100 + .3) + 3 * std::cos(2 * pi * i / 5000);
  const Profile long_waves(.1, z);
  const Profile primary = primary_profile(long_waves, {}, {});
  EXPECT_EQ(primary.size(), 5000);
  const ProfileParameters p = profile_parameters(primary, {.sections = 1});
  expect_near(p.Rq.value, std::sqrt(.5 + 4.5), 1e-9, "Pq");
  EXPECT_EQ(p.Rz.value, p.Rt);
  EXPECT_FALSE(p.Rz.u);
  // Without F the tilt remains; the sine correlates by 8e-4.
  const Profile level = sine(0);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = level.heights()[k] + .02 * static_cast<double>(k);
  const double tilted = profile_parameters(primary_profile(Profile(.1, z), {}, {}), {.sections = 1}).Rq.value;
  expect_near(tilted * tilted, .5 + .02 * .02 * (5000. * 5000 - 1) / 12, 2e-3, "Pq of a tilted trace");
  expect_near(profile_parameters(primary_profile(Profile(.1, z), 1, {}), {.sections = 1}).Rq.value,
              profile_parameters(levelled(level, 1), {.sections = 1}).Rq.value, 1e-9, "Pq less the tilt");
}

TEST(ProfileParameters, ThePrimaryProfileLosesHalfOfSAtEitherEnd) {
  // Half of the amplitude, except within about S/2 from the ends.
  const Profile primary = primary_profile(sine(0), {}, 10.);
  EXPECT_EQ(primary.size(), 4900);
  expect_near(profile_parameters(primary, {.sections = 1}).Rq.value, std::sqrt(.5) / 2, 1e-5, "Pq");
  EXPECT_EQ(primary_profile(sine(0), {}, 499.).size(), 10);
  EXPECT_THROW(primary_profile(sine(0), {}, 500.), Error);
  EXPECT_THROW(primary_profile(sine(0), {}, 0.), Error);
  EXPECT_THROW(primary_profile(sine(0), {}, -1.), Error);
  Array<double> ramp(100);
  for (std::size_t k = 0; k < 100; ++k) ramp[k] = .3 * static_cast<double>(k);
  EXPECT_THROW(primary_profile(Profile(1, ramp), 1, {}), Error);
  EXPECT_NO_THROW(primary_profile(Profile(1, ramp), {}, {}));
}

TEST(ProfileParameters, HolesAreLeftOut) {
  Array<double> z(5000);
  const Profile whole = sine(.05);
  for (std::size_t k = 0; k < z.size(); ++k)
    z[k] = k % 1000 == 17 ? std::numeric_limits<double>::quiet_NaN() : whole.heights()[k];
  const ProfileParameters p = profile_parameters(Profile::with_holes(.1, z));
  EXPECT_EQ(p.measured, 4995u);
  EXPECT_FALSE(p.Rsm);
  expect_near(p.Rq.value, 0.707990112925, 2e-3, "Rq");
  expect_near(p.Rdq.value(), 0.470244754812, 3e-3, "Rdq");
  std::fill(z.begin() + 1000, z.begin() + 2000, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(profile_parameters(Profile::with_holes(.1, z)), Error);
}

TEST(ProfileParameters, OfAMeasuredTrace) {
  const char* folder = std::getenv("ASPERITY_MEASURED");
  if (!folder) GTEST_SKIP() << "ASPERITY_MEASURED names no folder of measured files";
  const Profile read = read_profile(SourceFile(std::string(folder) + "/dektak-1.csv", Monitor::silent()));
  // Printed positions are rounded to 0.1 um.
  const Array<double> heights(read.heights().begin(), read.heights().end());
  const Profile trace = levelled(Profile(.15625e-6, heights), 1);
  const ProfileParameters p = profile_parameters(primary_profile(trace, {}, {}));
  const double um = 1e-6;
  expect_near(p.Ra.value / um, 0.0812542049347, 1e-9, "Ra");
  expect_near(p.Rq.value / um, 0.0942430489054, 1e-9, "Rq");
  expect_near(p.Rsk, -0.357047608983, 1e-9, "Rsk");
  expect_near(p.Rku, 2.130495267, 1e-9, "Rku");
  expect_near(p.Rp.value / um, 0.112060820349, 1e-9, "Rp");
  expect_near(p.Rv.value / um, 0.0855051936531, 1e-9, "Rv");
  expect_near(p.Rzx / um, 0.325652485504, 1e-9, "Rzx");
  expect_near(p.Rt / um, 0.456415246343, 1e-9, "Rt");
  expect_near(p.Rpt / um, 0.235845126125, 1e-9, "Rpt");
  expect_near(p.Rvt / um, 0.220570120218, 1e-9, "Rvt");
  expect_near(p.Rdq_edges.value(), 0.00945942215169, 1e-9, "Rdq by edges");
  expect_near(p.Rdq.value(), 0.00950039202968, 1e-9, "Rdq");
  expect_near(p.Rda.value(), 0.00405180738652, 1e-9, "Rda");
  expect_near(p.Rdr.value(), 4.46914287984e-05, 1e-9, "Rdr");
  expect_near(p.Rsm.value() / um, 232.095297404, 1e-9, "Rsm");
  expect_near(p.Rc.value() / um, 0.121532403563, 1e-9, "Rc");
  EXPECT_EQ(p.elements, 6u);
  expect_near(p.core.Sk / um, 0.204850368398, 1e-9, "Rk");
  expect_near(p.core.Spk / um, 0.0541572996252, 1e-9, "Rpk");
  expect_near(p.core.Svk / um, 0.121285528827, 1e-9, "Rvk");
  expect_near(p.Rdc / um, 0.121735211747, 1e-9, "Rdc");
  expect_near(p.Ra.u.value() / um, 0.00707389037304, 1e-9, "u of Ra");
  expect_near(p.Rq.u.value() / um, 0.00796085026078, 1e-9, "u of Rq");
  expect_near(p.Rz.u.value() / um, 0.0264266690345, 1e-9, "u of Rz");

  // Nic 250 um, 125 um cut from each end. The reference cuts its kernel at ±Nic: 1e-6.
  const PreparedProfile prepared = prepared_profile(trace, {.F = {}, .S = {}, .section = 250 * um});
  EXPECT_EQ(prepared.sections, 5);
  EXPECT_EQ(prepared.profile.size(), 8000);
  const ProfileParameters rough = profile_parameters(prepared.profile);
  expect_near(rough.Ra.value / um, 0.00460915454129, 1e-5, "Ra");
  expect_near(rough.Rz.value / um, 0.106504309175, 1e-5, "Rz");
  expect_near(rough.Rsm.value() / um, 47.5030062605, 1e-3, "Rsm");
  expect_near(rough.Rdq.value(), 0.00885093691901, 1e-5, "Rdq");
  expect_near(rough.core.Sk / um, 0.0113396692715, 1e-4, "Rk");
}

}  // namespace
}  // namespace asperity::profile_parameters_test
