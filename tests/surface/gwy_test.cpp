// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/little_endian.hpp"

namespace asperity::gwy_test {
namespace {

using testing::gwy_example;
using testing::gwy_inner;
using testing::gwy_object;
using testing::gwy_text;
using testing::GwyField;
using testing::message_of;

Surface read(const std::string& bytes, const std::string& channel = {}) {
  ReadOptions options;
  options.channel = channel;
  return read_surface(SourceFile("a.gwy", bytes), options);
}
std::string refusal(const std::string& content, const std::string& channel = {}) {
  return message_of([&] { read(gwy_example(content), channel); });
}
std::string map(int number, const GwyField& field, const std::string& title = {}) {
  const std::string key = "/" + std::to_string(number) + "/data";
  return (title.empty() ? "" : gwy_text(key + "/title", title)) + gwy_inner(key, field.object());
}

TEST(Gwy, MapIsReadWithSizeAndUnits) {
  const Surface s = read(gwy_example(map(0, {})));
  EXPECT_EQ(s.grid(), (Grid{3, 2, 3e-6, 4e-6}));
  EXPECT_EQ(s.height(2, 1), 3e-9);
  EXPECT_EQ(s.height(0, 0), 4e-9);
  GwyField other;
  other.unit_z = "nm";
  other.unit_xy = "um";
  other.size_x = 3;
  EXPECT_EQ(read(gwy_example(map(0, other))).height(0, 1), 1e-9 * 1e-9);
  EXPECT_EQ(read(gwy_example(map(0, other))).grid().size_x, 3e-6);
}

TEST(Gwy, FirstMapOfLengthsIsTaken) {
  GwyField phase;
  phase.unit_z = "deg";
  GwyField later;
  later.heights = {9, 8, 7, 6, 5, 4};
  const std::string content = map(12, later, "Late") + gwy_text("/0/base/palette", "Gray") +
                              map(3, phase, "Phase") + map(7, {}, "Height") +
                              gwy_inner("/brick/1", gwy_object("GwyBrick", ""));
  EXPECT_EQ(read(gwy_example(content)).height(0, 1), 1e-9);
  EXPECT_EQ(read(gwy_example(content), "Late").height(0, 1), 9);
  EXPECT_EQ(read(gwy_example(content), "12").height(0, 1), 9);
  EXPECT_EQ(refusal(content, "Phase"),
            "\"a.gwy\" holds the map 3 \"Phase\" in \"deg\", which is no unit of length; name a map of "
            "heights by its "
            "number or its title with `channel`");
  EXPECT_EQ(refusal(content, "Hieght"),
            "\"a.gwy\" holds no map `Hieght` (did you mean `Height`?) but 3 \"Phase\", 7 \"Height\" and 12 "
            "\"Late\"; "
            "name one by its number or its title with `channel`");
}

TEST(Gwy, MaskIsWarnedOf) {
  class Listening final : public Monitor {
   public:
    void progress(std::string_view, double) override {}
    void warn(std::string_view sentence) override { heard = sentence; }
    std::string heard;
  } monitor;
  const std::string content = map(0, {}) + gwy_inner("/0/mask", GwyField().object());
  read_surface(SourceFile("a.gwy", gwy_example(content)), {}, monitor);
  EXPECT_EQ(monitor.heard, "\"a.gwy\": the map 0 has a mask, which is not applied: all its points are read");
}

TEST(Gwy, WrittenSurfaceReadsBackBitForBit) {
  const testing::Scratch scratch;
  Field heights(5, 3);
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = 1e-6 / static_cast<double>(k + 3);
  const Surface surface(Grid{5, 3, 5e-4, 0.3e-3}, std::move(heights));
  write_surface(surface, scratch.path("a.gwy"));
  const Surface found = read_surface(scratch.path("a.gwy"));
  EXPECT_EQ(found.grid(), surface.grid());
  EXPECT_EQ(found.digest(), surface.digest());
  EXPECT_EQ(read_surface(scratch.path("a.gwy"), {.size_x = {},
                                                 .size_y = {},
                                                 .unit = {},
                                                 .fill = {},
                                                 .format = {},
                                                 .channel = "height",
                                                 .material = {}})
                .digest(),
            surface.digest());
}

TEST(Gwy, EachFaultIsSaid) {
  EXPECT_EQ(refusal(""), "\"a.gwy\" holds no map; maps are the GwyDataFields of a Gwyddion file");
  EXPECT_EQ(refusal(map(0, {.nx = 4})),
            "\"a.gwy\" says in its header that it holds 4 x 2 heights of 8 bytes but has 48 bytes of data; "
            "the file is "
            "cut short or its header is wrong");
  EXPECT_EQ(refusal(map(0, {.ny = -2})),
            "\"a.gwy\" says in its header that it holds 3 x 0 heights; its header is wrong");
  EXPECT_EQ(refusal(map(0, {.size_x = 0})), "\"a.gwy\" gives the map 0 a size of 0");
  EXPECT_EQ(refusal(std::string("key\0?", 5)), "\"a.gwy\" has a component \"key\" of the unknown type \"?\"");
  EXPECT_EQ(refusal("key"), "\"a.gwy\" is cut short in an object");
  const std::string whole = gwy_example(map(0, {}));
  EXPECT_EQ(message_of([&] { read(whole.substr(0, whole.size() - 1)); }),
            "\"a.gwy\" is cut short in its outermost object");
  EXPECT_EQ(message_of([&] { read("GWYP" + gwy_object("GwyBrick", "")); }),
            "\"a.gwy\" holds an object \"GwyBrick\" instead of a GwyContainer");
  EXPECT_EQ(message_of([&] { read("GWYO"); }),
            "\"a.gwy\" lacks the mark of the format `gwy`: GWYP at the start; if it is another format, name "
            "it with `format`");
}

TEST(Gwy, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(gwy_example(map(0, {}, "Height") + map(1, {})), 51, 6000,
                  [](const std::string& bytes) { read(bytes); });
}

}  // namespace
}  // namespace asperity::gwy_test
