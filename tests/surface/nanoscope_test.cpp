// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/scanning_probe_files.hpp"

namespace asperity::nanoscope_test {
namespace {

using testing::message_of;

using Image = testing::NanoscopeImageExample;
using testing::nanoscope;

Surface read(const std::string& bytes, const std::string& channel = {}) {
  ReadOptions options;
  options.channel = channel;
  return read_surface(SourceFile("a.spm", bytes), options);
}
std::string refusal(const Image& image, const std::string& channel = {}) {
  return message_of([&] { read(nanoscope({image}), channel); });
}

TEST(Nanoscope, HeightsAreVoltsTimesTheSensitivityFirstLineLowest) {
  const Surface s = read(nanoscope({Image{}}));
  EXPECT_EQ(s.grid().nx, 3);
  EXPECT_EQ(s.grid().ny, 2);
  EXPECT_NEAR(s.grid().size_x, 30e-9, 1e-22);
  EXPECT_NEAR(s.grid().size_y, 40e-9, 1e-22);
  // 65.536 V / 65536 = 1 mV, times 20 nm/V
  EXPECT_NEAR(s.height(0, 0), 20e-12, 1e-24);
  EXPECT_NEAR(s.height(0, 1), -80e-12, 1e-24);
  EXPECT_NEAR(s.height(2, 1), -32768 * 20e-12, 1e-20);
  EXPECT_EQ(s.measured(), 6U);
}

TEST(Nanoscope, WideIntegersAreScaledByTheBytesOfAPixel) {
  const std::string wide = testing::raw(std::vector<std::int32_t>{65536, 2, 3, 4, 5, 6});
  const Surface four = read(nanoscope({{.bytes_a_pixel = 4, .data = wide}}));
  EXPECT_NEAR(four.height(0, 0), 20e-12, 1e-24);
  const Surface two = read(nanoscope({{.bytes_a_pixel = 2, .data = wide}}));
  EXPECT_NEAR(two.height(0, 0), 65536 * 20e-12, 1e-19);
}

TEST(Nanoscope, SensitivitiesHaveUnitsOfTheirOwn) {
  const Surface micro = read(nanoscope({{.sensitivity = "Sens. ZsensSens"}}));
  EXPECT_NEAR(micro.height(0, 0), 400e-12, 1e-23);
  const Surface milli = read(nanoscope({{.volts = "65.53600 mV"}}));
  EXPECT_NEAR(milli.height(0, 0), 20e-15, 1e-27);
  const Surface wide = read(nanoscope({{.scan_size = "3 ~m"}}));
  EXPECT_NEAR(wide.grid().size_x, 3e-6, 1e-19);
  EXPECT_NEAR(wide.grid().size_y, 3e-6, 1e-19);
}

TEST(Nanoscope, ChannelNamesTheImageAndSeveralOfHeightsAreAskedFor) {
  Image retrace{.line = "Retrace"};
  retrace.data = testing::raw(std::vector<std::int16_t>{9, 9, 9, 9, 9, 8});
  const Image phase{.title = "Phase", .sensitivity = "Sens. Phase"};
  const std::string bytes = nanoscope({Image{}, retrace, phase});
  EXPECT_EQ(
      message_of([&] { read(bytes); }),
      "\"a.spm\" holds several maps of heights: `Height, trace` and `Height, retrace`; name one of them "
      "with `channel`");
  EXPECT_NEAR(read(bytes, "Height, retrace").height(2, 1), 8 * 20e-12, 1e-22);
  EXPECT_EQ(message_of([&] { read(bytes, "Height, Trace"); }),
            "\"a.spm\" holds no map `Height, Trace` (did you mean `Height, trace`?) but `Height, trace`, "
            "`Height, retrace` and `Phase`; name one of them with `channel`");
  EXPECT_EQ(message_of([&] { read(bytes, "Phase"); }),
            "\"a.spm\" holds the map `Phase` in V, which is no unit of length; name a map of heights with "
            "`channel`");
  EXPECT_NEAR(read(nanoscope({phase, retrace})).height(2, 1), 8 * 20e-12, 1e-22);
  EXPECT_NE(message_of([&] { read(nanoscope({phase})); }).find("holds no map of heights but `Phase`"),
            std::string::npos);
}

TEST(Nanoscope, AScanThatWasStoppedIsToldOf) {
  ReadOptions options;
  const std::string valid = "\\Valid data len Y: ";
  for (const auto& [lines, told] : {std::pair{"2", 0U}, std::pair{"1", 1U}}) {
    test::Warnings warnings;
    std::string bytes = nanoscope({Image{}});
    const std::string line = valid + lines + "\r\n";
    const std::size_t at = bytes.find("\\Line Direction");
    bytes.insert(at, line);
    bytes.erase(bytes.find('\0'), line.size());
    read_surface(SourceFile("a.spm", bytes), options, warnings);
    EXPECT_EQ(warnings.all.size(), told);
  }
}

TEST(Nanoscope, AnAspectThatTheSizeContradictsIsToldOf) {
  for (const auto& [aspect, told] : {std::pair{"3:4", 0U}, std::pair{"1:1", 1U}}) {
    test::Warnings warnings;
    const Image image{.line = std::string("Trace\r\n\\Aspect Ratio: ") + aspect};
    read_surface(SourceFile("a.spm", nanoscope({image})), {}, warnings);
    EXPECT_EQ(warnings.all.size(), told) << aspect;
  }
  EXPECT_NE(refusal({.line = "Trace\r\n\\Aspect Ratio: x:y"}).find("has no number for `aspect ratio`"),
            std::string::npos);
}

TEST(Nanoscope, EachFaultIsSaid) {
  EXPECT_EQ(refusal({.nx = 4}),
            "\"a.spm\" says in its header that it holds 4 x 2 heights of 2 bytes but has 12 bytes of data; "
            "the file is cut short or its header is wrong");
  EXPECT_NE(refusal({.ny = 0}).find("holds 3 x 0 heights"), std::string::npos);
  EXPECT_NE(refusal({.nx = 1}).find("8 too many"), std::string::npos);
  EXPECT_NE(refusal({.scan_size = "0 0 nm"}).find("has no length for `scan size`"), std::string::npos);
  EXPECT_NE(refusal({.scan_size = "3 3 V"}).find("has no length for `scan size`"), std::string::npos);
  EXPECT_NE(refusal({.scan_size = "nan nm"}).find("has no length for `scan size`"), std::string::npos);
  EXPECT_EQ(refusal({.sensitivity = "Sens. Nothing"}),
            "\"a.spm\" has an image scaled by \"@sens. nothing\", and its header lacks this scale");
  EXPECT_EQ(refusal({.volts = "0 V"}), "\"a.spm\" gives one unit of its heights as 0 m");
  EXPECT_NE(refusal({.volts = "1 A"}).find("has an image scaled in \"A\" with a sensitivity in \"nm/V\""),
            std::string::npos);
  EXPECT_NE(refusal({.bytes_a_pixel = 3}).find("heights of 3 bytes a pixel"), std::string::npos);
  const std::string whole = nanoscope({Image{}});
  EXPECT_EQ(message_of([&] { read(whole.substr(0, whole.size() - 1)); }),
            "\"a.spm\" has an image of 12 bytes from byte 4096 on past its end; the file is cut short");
  EXPECT_EQ(message_of([&] { read(whole.substr(0, 300)); }),
            "\"a.spm\" has a header without \\*File list end; the file is cut short");
  EXPECT_NE(message_of([] { read(nanoscope({})); }).find("holds no map"), std::string::npos);
}

TEST(Nanoscope, DamageIsAnErrorOrAnotherSurface) {
  std::string bytes = nanoscope({Image{}, Image{.title = "Phase", .sensitivity = "Sens. Phase"}});
  testing::damage(bytes, 51, 2000, [](const std::string& damaged) { read(damaged); });
}

}  // namespace
}  // namespace asperity::nanoscope_test
