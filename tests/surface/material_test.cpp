// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/material.hpp"
#include "engine/core/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::material_test {
namespace {

using test::refusal;

Material elastic(double young, double poisson) {
  Material material;
  material.young = young;
  material.poisson = poisson;
  return material;
}

TEST(Material, TheSpecimensOfThePaper) {
  const Material& al = named_material("Al-2011");
  EXPECT_EQ(al.young, 70e9);
  EXPECT_EQ(al.poisson, 0.33);
  EXPECT_EQ(al.hardness, 1.1e9);
  EXPECT_EQ(al.density, 2830.0);
  const Material& quartz = named_material("quartz");
  EXPECT_EQ(quartz.young, 95e9);
  EXPECT_EQ(quartz.poisson, 0.08);
}

TEST(Material, EveryNamedOneIsInRangeAndFoundByName) {
  ASSERT_FALSE(named_materials().empty());
  for (const Material& material : named_materials()) {
    EXPECT_NO_THROW(check(material)) << material.name;
    EXPECT_EQ(&named_material(material.name), &material);
    EXPECT_FALSE(material.source.empty()) << material.name;
  }
}

TEST(Material, UnknownNameProposesTheNearest) {
  const std::string text = refusal([] { named_material("quarz"); }, ErrorCode::unknown_name);
  EXPECT_EQ(text.substr(0, 60), "there is no material `quarz` (did you mean `quartz`?); named");
}

TEST(Material, PlaneStrainModulus) {
  EXPECT_DOUBLE_EQ(plane_strain_modulus(elastic(3, 0.5)), 4);
  EXPECT_DOUBLE_EQ(plane_strain_modulus(elastic(3, 0)), 3);
  EXPECT_EQ(plane_strain_modulus(rigid_material()), infinity);
}

TEST(Material, MissingElasticityIsNamed) {
  Material material;
  EXPECT_EQ(refusal([&] { plane_strain_modulus(material); }, ErrorCode::bad_state),
            "the material given has no `young`; give it in lab.material{...}");
  material.name = "jelly";
  material.young = 1e3;
  EXPECT_EQ(refusal([&] { plane_strain_modulus(material); }, ErrorCode::bad_state),
            "the material `jelly` has no `poisson`; give it in lab.material{...}");
}

TEST(Material, Ranges) {
  const auto with = [](auto member, double value) {
    Material material;
    material.*member = value;
    return refusal([&] { check(material); }, ErrorCode::bad_value);
  };
  const std::string above_zero = "; give a finite value above zero";
  EXPECT_EQ(with(&Material::young, 0), "`young` is 0" + above_zero);
  EXPECT_EQ(with(&Material::young, infinity), "`young` is inf" + above_zero);
  EXPECT_EQ(with(&Material::density, -1), "`density` is -1" + above_zero);
  EXPECT_EQ(with(&Material::hardness, 0), "`hardness` is 0; give a value above zero");
  EXPECT_EQ(with(&Material::hardness, infinity), "accepted");  // never yields
  const std::string poisson = "; give a number above -1 and at most 0.5";
  EXPECT_EQ(with(&Material::poisson, 0.5), "accepted");
  EXPECT_EQ(with(&Material::poisson, std::nextafter(0.5, 1.0)), "`poisson` is 0.5" + poisson);
  EXPECT_EQ(with(&Material::poisson, -1), "`poisson` is -1" + poisson);
  EXPECT_EQ(with(&Material::poisson, std::nextafter(-1.0, 0.0)), "accepted");
  EXPECT_EQ(with(&Material::poisson, std::nan("")), "`poisson` is nan" + poisson);
}

}  // namespace
}  // namespace asperity::material_test
