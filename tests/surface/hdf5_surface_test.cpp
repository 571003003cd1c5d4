// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/hdf5_surface.hpp"

#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "tests/surface/files.hpp"

namespace asperity::hdf5_surface_test {
namespace {

using testing::message_of;
using testing::Scratch;

Surface rough() {
  Field heights(5, 3);
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = 1e-6 / static_cast<double>(k + 3);
  heights[7] = -0.0;
  heights[8] = 5e-324;
  return Surface(Grid{5, 3, 5e-4, 0.3e-3}, std::move(heights));
}

Hdf5Array map(const std::string& name, const std::string& unit) {
  return owning_array<double>(name, {2, 3}, {1, 2, 3, 4, 5, 6}, unit);
}

std::string written(const Scratch& scratch, const Hdf5Content& content) {
  write_hdf5(scratch.path("a.h5"), content);
  return scratch.path("a.h5");
}

TEST(Hdf5Surface, ReadsBackBitForBit) {
  const Scratch scratch;
  const Surface surface = rough();
  write_surface(surface, scratch.path("a.h5"));
  const Surface found = read_surface(scratch.path("a.h5"));
  EXPECT_EQ(found.grid(), surface.grid());
  EXPECT_EQ(found.digest(), surface.digest());
  for (std::size_t k = 0; k < found.heights().size(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(found.heights()[k]),
              std::bit_cast<std::uint64_t>(surface.heights()[k]));
}

TEST(Hdf5Surface, SameSurfaceGivesTheSameBytes) {
  const Scratch scratch;
  write_surface(rough(), scratch.path("a.h5"));
  const std::string first = testing::bytes_of(scratch.path("a.h5"));
  write_surface(rough(), scratch.path("a.h5"));
  EXPECT_EQ(testing::bytes_of(scratch.path("a.h5")), first);
  EXPECT_EQ(scratch.entries(), 2u);
}

TEST(Hdf5Surface, OnlyMapIsTakenWithItsUnit) {
  const Scratch scratch;
  const std::string path =
      written(scratch, {{}, {map("scan/topography", "um"), tile_size(Grid{3, 2, 3e-3, 2e-3})}});
  const Surface found = read_surface(path);
  EXPECT_EQ(found.grid(), (Grid{3, 2, 3e-3, 2e-3}));
  EXPECT_EQ(found.height(2, 1), 6e-6);
}

TEST(Hdf5Surface, IntegersAndUnknownUnitsNeedTheCallsUnit) {
  const Scratch scratch;
  const std::string path =
      written(scratch, {{}, {owning_array<std::int64_t>("counts", {1, 2}, {-3, 7}, "digits")}});
  EXPECT_EQ(message_of([&] { read_surface(path); }),
            "\"" + path +
                "\" does not say its size and unit; give `size` and `unit` in the call: `unit` is the length "
                "of one number, such as \"um\"");
  const Surface found = read_surface(
      path, {.size_x = 1, .size_y = 1, .unit = 0.5, .fill = {}, .format = {}, .channel = {}, .material = {}});
  EXPECT_EQ(found.height(0, 0), -1.5);
}

TEST(Hdf5Surface, ChannelChoosesAmongSeveral) {
  const Scratch scratch;
  const std::string path =
      written(scratch, {{}, {map("gap", "m"), map("pressure", "Pa"), tile_size(Grid{3, 2, 1, 1})}});
  EXPECT_EQ(message_of([&] { read_surface(path); }),
            "\"" + path +
                "\" holds several arrays, and none is called `height`: `gap` (2 x 3), `pressure` (2 x 3) "
                "and `size` (2); name the one to read with `channel`");
  ReadOptions options;
  options.channel = "gap";
  EXPECT_EQ(read_surface(path, options).height(1, 0), 2);
  options.channel = "pressure";
  EXPECT_EQ(message_of([&] { read_surface(path, options); }),
            "\"" + path +
                "\" holds `pressure` in Pa, which is a pressure; name an array of heights with `channel`");
  options.channel = "gab";
  EXPECT_EQ(
      message_of([&] { read_surface(path, options); }),
      "\"" + path +
          "\" holds no map `gab` (did you mean `gap`?) but `gap` (2 x 3), `pressure` (2 x 3) and `size` "
          "(2); name an array of two dimensions with `channel`");
}

TEST(Hdf5Surface, FileWithoutMapsSaysWhatItHolds) {
  const Scratch scratch;
  EXPECT_EQ(message_of([&] { read_surface(written(scratch, {})); }),
            "\"" + scratch.path("a.h5") +
                "\" holds no map of heights but nothing; a surface is an array of numbers of "
                "shape (ny, nx)");
}

TEST(Hdf5Surface, DamageIsAnError) {
  const Scratch scratch;
  write_surface(rough(), scratch.path("a.h5"));
  const std::string whole = testing::bytes_of(scratch.path("a.h5"));
  testing::damage(whole, 11, 3000,
                  [&](const std::string& bytes) { read_surface(SourceFile("a.h5", bytes)); });
}

TEST(Xdmf, DescribesWhatStandsInTheHdf5File) {
  const Scratch scratch;
  const Surface surface = rough();
  write_surface(surface, scratch.path("a&b.h5"));
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file(scratch.path("a&b.xdmf").c_str()));
  const pugi::xml_node grid = document.child("Xdmf").child("Domain").child("Grid");
  EXPECT_STREQ(grid.child("Topology").attribute("Dimensions").value(), "1 3 5");
  EXPECT_STREQ(grid.child("Topology").attribute("TopologyType").value(), "3DCoRectMesh");
  // Slowest axis first.
  const pugi::xml_node origin = grid.child("Geometry").child("DataItem");
  EXPECT_STREQ(origin.text().get(), "0 0 0");
  EXPECT_STREQ(origin.next_sibling().text().get(), "1e-04 9.999999999999999e-05 1e-04");
  const pugi::xml_node height = grid.child("Attribute");
  EXPECT_STREQ(height.attribute("Name").value(), "height [m]");
  EXPECT_STREQ(height.attribute("Center").value(), "Node");
  const std::string place = height.child("DataItem").text().get();
  EXPECT_EQ(place, "a&b.h5:/height");
  EXPECT_STREQ(height.child("DataItem").attribute("Dimensions").value(), "1 3 5");
  EXPECT_STREQ(height.child("DataItem").attribute("Precision").value(), "8");
  const Hdf5Content content = read_hdf5(scratch.path(place.substr(0, place.find(":/"))));
  const Hdf5Array* const array = content.array(place.substr(place.find(":/") + 2));
  ASSERT_NE(array, nullptr);
  EXPECT_EQ(array->shape, (std::vector<std::size_t>{3, 5}));
  // `size` is not a field of the tile.
  EXPECT_FALSE(height.next_sibling());
}

TEST(Xdmf, NumbersOfEveryKindHaveTheirWidth) {
  Hdf5Content content;
  content.arrays.push_back(owning_array<std::uint8_t>("contact", {1, 2}, {0, 1}));
  content.arrays.push_back(owning_array<std::int64_t>("spots", {1, 2}, {0, 1}));
  const std::string text = xdmf_text(Grid{2, 1, 2, 1}, "state \"1\" <2>", content, "folder/file.h5");
  EXPECT_NE(text.find("Name=\"state &quot;1&quot; &lt;2>\""), std::string::npos);
  EXPECT_NE(text.find("NumberType=\"UChar\" Precision=\"1\">file.h5:/contact<"), std::string::npos) << text;
  EXPECT_NE(text.find("NumberType=\"Int\" Precision=\"8\">file.h5:/spots<"), std::string::npos) << text;
}

}  // namespace
}  // namespace asperity::hdf5_surface_test
