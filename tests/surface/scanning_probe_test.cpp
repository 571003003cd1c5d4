// SPDX-License-Identifier: GPL-3.0-or-later
// Units, orientation, missing points, choice of the map, header faults.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/scanning_probe_files.hpp"

namespace asperity::scanning_probe_test {
namespace {

using testing::message_of;
using testing::raw;

constexpr float nan_single = std::numeric_limits<float>::quiet_NaN();

Surface read(const std::string& name, const std::string& bytes, const std::string& channel = {}) {
  ReadOptions options;
  options.channel = channel;
  return read_surface(SourceFile(name, bytes), options);
}
std::string refusal(const std::string& name, const std::string& bytes, const std::string& channel = {}) {
  return message_of([&] { read(name, bytes, channel); });
}
void expect_refusal(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}
void expect_size(const Surface& surface, double x, double y) {
  EXPECT_EQ(surface.grid().nx, 3);
  EXPECT_EQ(surface.grid().ny, 2);
  EXPECT_NEAR(surface.grid().size_x, x, 1e-12 * x);
  EXPECT_NEAR(surface.grid().size_y, y, 1e-12 * y);
}

// --- NID

TEST(Nid, NumbersAreSharesOfARangeFirstLineLowest) {
  const Surface s = read("a.nid", testing::nid_example({{}}));
  expect_size(s, 30e-6, 40e-6);
  const double step = 2e-6 / 4294967296.0;
  EXPECT_NEAR(s.height(0, 0), 0, 1e-20);  // the middle of the range
  EXPECT_NEAR(s.height(2, 0) - s.height(0, 0), 2 * step, 1e-3 * step);
  EXPECT_NEAR(s.height(0, 1) - s.height(0, 0), -3 * step, 1e-3 * step);
  const Surface low = read(
      "a.nid", testing::nid_example({{.range = "4e-06",
                                      .least = "1e-06",
                                      .bits = "16",
                                      .data = raw(std::vector<std::int16_t>{-32768, 0, 0, 0, 0, 16384})}}));
  EXPECT_NEAR(low.height(0, 0), 1e-6, 1e-18);
  EXPECT_NEAR(low.height(2, 1), 4e-6, 1e-18);
}

TEST(Nid, ChannelNamesTheImage) {
  const testing::NidImageExample force{.name = "Deflection", .unit = "N"};
  testing::NidImageExample back{.frame = "Scan backward"};
  back.data = raw(std::vector<std::int32_t>{9, 0, 0, 0, 0, 0});
  const std::string bytes = testing::nid_example({force, {}, back});
  EXPECT_EQ(
      refusal("a.nid", bytes),
      "\"a.nid\" holds several maps of heights: `Z-Axis, Scan forward` and `Z-Axis, Scan backward`; name "
      "one of them with `channel`");
  EXPECT_GT(read("a.nid", bytes, "Z-Axis, Scan backward").height(0, 0), 0);
  // Amperes are not angstroms.
  expect_refusal(refusal("a.nid", testing::nid_example({{.unit = "A"}}), "Z-Axis, Scan forward"),
                 "in \"A\", which is no unit of length");
  expect_refusal(refusal("a.nid", bytes, "Deflection, Scan forward"), "in \"N\", which is no unit of length");
}

TEST(Nid, EachFaultIsSaid) {
  expect_refusal(refusal("a.nid", testing::nid_example({{.lines = "3"}})),
                 "3 x 3 heights of 4 bytes but has 24");
  expect_refusal(refusal("a.nid", testing::nid_example({{.lines = "1"}})), "12 bytes after its last image");
  expect_refusal(refusal("a.nid", testing::nid_example({{.lines = "-2"}})), "has no count for `Lines`");
  expect_refusal(refusal("a.nid", testing::nid_example({{.bits = "8"}})), "numbers are not as usual");
  expect_refusal(refusal("a.nid", testing::nid_example({{.range = "0"}})), "gives 0 as its Dim2Range");
  expect_refusal(refusal("a.nid", testing::nid_example({{.range = "inf"}})), "has no number for `Dim2Range`");
  expect_refusal(refusal("a.nid", testing::nid_example({})), "holds no map");
}

// --- IBW

TEST(Ibw, WavesAreMapsWithTheirSteps) {
  const Surface s = read("a.ibw", testing::IbwExample{}(std::vector<float>{1, 2, 3, 4, nan_single, 6}));
  expect_size(s, 3e-8, 4e-8);
  EXPECT_EQ(s.height(0, 1), 4);
  EXPECT_EQ(s.measured(), 5U);
  EXPECT_TRUE(std::isnan(s.height(1, 1)));
  const Surface wide =
      read("a.ibw", testing::IbwExample{.type = 4}(std::vector<double>{1, 2, 3, 4, 5, 6e-9}));
  EXPECT_EQ(wide.height(2, 1), 6e-9);
}

TEST(Ibw, LabelsNameTheMaps) {
  const testing::IbwExample example{.maps = 3, .labels = {"HeightTrace", "PhaseTrace", "HeightRetrace"}};
  const std::string bytes =
      example(std::vector<float>{1, 2, 3, 4, 5, 6, 11, 12, 13, 14, 15, 16, 21, 22, 23, 24, 25, 26});
  expect_refusal(refusal("a.ibw", bytes), "several maps of heights: `HeightTrace` and `HeightRetrace`");
  EXPECT_EQ(read("a.ibw", bytes, "HeightRetrace").height(0, 1), 24);
  expect_refusal(refusal("a.ibw", bytes, "PhaseTrace"), "`PhaseTrace`, which is not of heights");
}

TEST(Ibw, EachFaultIsSaid) {
  const std::vector<float> six{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(
      refusal("a.ibw", testing::IbwExample{.data_unit = "", .unit = ""}(six)),
      "\"a.ibw\" does not say its size and unit; give `size` and `unit` in the call: `unit` is the length "
      "of one number, such as \"um\"");
  expect_refusal(refusal("a.ibw", testing::IbwExample{.data_unit = "V"}(six)), "gives its heights in \"V\"");
  expect_refusal(refusal("a.ibw", testing::IbwExample{.nx = 4}(six)), "4 x 2 heights of 4 bytes but has 24");
  expect_refusal(refusal("a.ibw", testing::IbwExample{.ny = 1}(six)), "1 maps of 3 x 1 and 6 numbers");
  expect_refusal(refusal("a.ibw", testing::IbwExample{.nx = -1}(six)), "it holds 4294967295 x 2 heights");
  expect_refusal(refusal("a.ibw", testing::IbwExample{.ny = 0}(six)), "is a wave that is no map");
  expect_refusal(refusal("a.ibw", testing::IbwExample{.step_y = 0}(six)), "gives 0 as the step");
  expect_refusal(refusal("a.ibw", testing::IbwExample{.type = 3}(six)), "is a wave of numbers of type 3");
  std::string bytes = testing::IbwExample{}(six);
  expect_refusal(refusal("a.ibw", bytes.substr(0, 400)), "344 bytes and has 400 in all");
  bytes[100] = 'x';
  expect_refusal(refusal("a.ibw", bytes), "a header whose sum is 0");
}

// --- MI

TEST(Mi, NumbersAreSharesOfTheRangeFirstLineLowest) {
  const Surface s =
      read("a.mi", testing::mi_example({{}}, raw(std::vector<std::int16_t>{1, 2, 3, -4, 5, 16384})));
  expect_size(s, 30e-6, 40e-6);
  EXPECT_NEAR(s.height(2, 1), 1e-6, 1e-18);
  EXPECT_NEAR(s.height(0, 1), -4 * 2e-6 / 32768, 1e-20);
  const Surface wide = read(
      "a.mi", testing::mi_example({{}}, raw(std::vector<std::int32_t>{1 << 30, 2, 3, 4, 5, 6}), "BINARY_32"));
  EXPECT_NEAR(wide.height(0, 0), 1e-6, 1e-18);
}

TEST(Mi, BuffersAreNamedByLabelAndTrace) {
  const std::vector<testing::MiBufferExample> buffers{
      {.label = "Friction", .unit = "V"}, {}, {.trace = "Retrace"}};
  std::vector<std::int16_t> numbers(18, 0);
  numbers[12] = 16384;
  const std::string bytes = testing::mi_example(buffers, raw(numbers));
  expect_refusal(refusal("a.mi", bytes), "`Topography, Trace` and `Topography, Retrace`");
  EXPECT_NEAR(read("a.mi", bytes, "Topography, Retrace").height(0, 0), 1e-6, 1e-18);
  expect_refusal(refusal("a.mi", bytes, "Friction"), "in \"V\", which is no unit of length");
}

TEST(Mi, OfVeryManyBuffersAFewAreNamed) {
  const std::string bytes =
      testing::mi_example(std::vector<testing::MiBufferExample>(100), raw(std::vector<std::int16_t>(600, 1)));
  expect_refusal(refusal("a.mi", bytes), "`Topography, Trace`, `Topography, Trace (2)`, ");
  expect_refusal(refusal("a.mi", bytes), "`Topography, Trace (24)` and 76 more; name one of them");
  EXPECT_EQ(refusal("a.mi", bytes, "Topography, Trace (100)"), "no error");
}

TEST(Mi, EachFaultIsSaid) {
  const std::string six = raw(std::vector<std::int16_t>{1, 2, 3, 4, 5, 6});
  expect_refusal(refusal("a.mi", testing::mi_example({{}}, six, "ASCII")), "numbers of the kind \"ASCII\"");
  expect_refusal(refusal("a.mi", testing::mi_example({{}}, six, "BINARY", "4")), "but has 12 bytes of data");
  expect_refusal(refusal("a.mi", testing::mi_example({{}}, six, "BINARY", "2")), "but has 12 bytes of data");
  expect_refusal(refusal("a.mi", testing::mi_example({{.range = "0"}}, six)), "gives 0 as its bufferRange");
  expect_refusal(refusal("a.mi", testing::mi_example({}, six)), "holds no map");
  expect_refusal(refusal("a.mi", testing::mi_example({{}}, six).substr(0, 60)), "without the line `data`");
}

// --- WSxM

TEST(Wsxm, TheFirstNumberIsTheLowerRightCorner) {
  const Surface s = read("a.stp", testing::WsxmExample{}(raw(std::vector<double>{1, 2, 3, 4, 5, 6})));
  expect_size(s, 30e-9, 40e-9);
  EXPECT_NEAR(s.height(2, 0), 1e-9, 1e-21);
  EXPECT_NEAR(s.height(0, 0), 3e-9, 1e-21);
  EXPECT_NEAR(s.height(0, 1), 6e-9, 1e-21);
}

TEST(Wsxm, HeightsSpanTheAmplitude) {
  const Surface s = read(
      "a.top", testing::WsxmExample{.type = "short"}(raw(std::vector<std::int16_t>{0, 2, 3, 4, 50, 100})));
  EXPECT_NEAR(s.height(0, 1) - s.height(2, 0), 5e-9, 1e-21);
  // Rounding to six digits is no scale.
  const Surface digits = read(
      "a.stp", testing::WsxmExample{.amplitude = "5.00001 nm"}(raw(std::vector<double>{1, 2, 3, 4, 5, 6})));
  EXPECT_NEAR(digits.height(0, 1), 6e-9, 1e-21);
  const Surface hole = read(
      "a.stp", testing::WsxmExample{.type = "float"}(raw(std::vector<float>{1, 2, nan_single, 4, 5, 6})));
  EXPECT_EQ(hole.measured(), 5U);
  EXPECT_TRUE(std::isnan(hole.height(0, 0)));
}

TEST(Wsxm, EachFaultIsSaid) {
  const std::string six = raw(std::vector<double>{1, 2, 3, 4, 5, 6});
  expect_refusal(refusal("a.stp", testing::WsxmExample{.columns = "4"}(six)), "but has 48 bytes of data");
  expect_refusal(refusal("a.stp", testing::WsxmExample{.columns = "2"}(six)), "16 too many");
  expect_refusal(refusal("a.stp", testing::WsxmExample{.type = "bits"}(six)), "numbers of the type \"bits\"");
  expect_refusal(refusal("a.stp", testing::WsxmExample{.amplitude = "5 V"}(six)), "which is no length");
  expect_refusal(refusal("a.stp", testing::WsxmExample{.size = "0 nm"}(six)), "no length for `X Amplitude`");
  expect_refusal(refusal("a.stp", testing::WsxmExample{.size = "1,5 nm"}(six)),
                 "no length for `X Amplitude`");
  expect_refusal(refusal("a.stp", testing::WsxmExample{}(raw(std::vector<double>(6, 2.0)))),
                 "gives no scale");
  expect_refusal(refusal("a.stp", testing::WsxmExample{}(six).substr(0, 100)), "is cut short in its header");
  expect_refusal(refusal("a.stp", testing::WsxmExample{.kind = "IV file"}(six)),
                 "a WSxM file other than an image");
}

// --- Park

TEST(Park, NumbersAreScaledThenGainedFirstLineLowest) {
  const Surface s = read("a.tiff", testing::ParkExample{}(std::vector<float>{1, 2, 3, 4, 5, nan_single}));
  expect_size(s, 3e-6, 4e-6);
  EXPECT_NEAR(s.height(0, 1), -8e-9, 1e-21);
  EXPECT_EQ(s.measured(), 5U);
  const testing::ParkExample short_example{.number_type = 0, .scale = 10, .offset = 1};
  const Surface integers = read("a.tiff", short_example(std::vector<std::int16_t>{1, 2, 3, 4, 5, -6}));
  EXPECT_NEAR(integers.height(2, 1), 118e-9, 1e-20);
  const testing::ParkExample first{.number_type = 2, .version = 0x01000001};
  const Surface old = read("a.tiff", first(std::vector<std::int16_t>{1, 2, 3, 4, 5, -6}));
  EXPECT_NEAR(old.height(0, 0), -2e-9, 1e-21);
}

TEST(Park, EachFaultIsSaid) {
  const std::vector<float> six{1, 2, 3, 4, 5, 6};
  expect_refusal(refusal("a.tiff", testing::ParkExample{.nx = 4}(six)), "but has 24 bytes of data");
  expect_refusal(refusal("a.tiff", testing::ParkExample{.nx = 0xFFFFFFFF}(six)),
                 "holds 4294967295 x 2 heights");
  expect_refusal(refusal("a.tiff", testing::ParkExample{.image_type = 1}(six)), "is a line profile");
  expect_refusal(refusal("a.tiff", testing::ParkExample{.swapped = 1}(six)), "with x and y swapped");
  expect_refusal(refusal("a.tiff", testing::ParkExample{.number_type = 3}(six)), "numbers of type 3");
  expect_refusal(refusal("a.tiff", testing::ParkExample{.version = 7}(six)), "of an unknown version");
  expect_refusal(refusal("a.tiff", testing::ParkExample{.size_x = -1}(six)), "gives -1 as its size");
  expect_refusal(refusal("a.tiff", testing::ParkExample{.gain = 0}(six)), "gives 0 as a factor");
  expect_refusal(refusal("a.tiff", testing::ParkExample{.unit = "V"}(six)), "`Z Height` in \"V\"");
  const std::string whole = testing::ParkExample{}(six);
  expect_refusal(refusal("a.tiff", whole.substr(0, whole.size() - 1)), "has its header past its end");
  expect_refusal(refusal("a.tiff", std::string("II*\0\x08\0\0\0\0\0", 10)), "is a TIFF picture");
}

// --- OPDx

TEST(Opdx, ProfilesReachFromTheFirstSampleToTheLast) {
  const std::vector<double> values{1, 2, 3, std::nan(""), -5};
  const Profile p = read_profile(SourceFile("a.opdx", testing::OpdxExample{}(values)));
  EXPECT_NEAR(p.spacing(), 1e-6, 1e-18);
  ASSERT_EQ(p.measured_heights().size(), 5U);
  EXPECT_NEAR(p.measured_heights()[4], -2.5e-6, 1e-18);
  EXPECT_EQ(p.measured(), 4U);
}

TEST(Opdx, EachFaultIsSaid) {
  const std::vector<double> values{1, 2, 3, 4, 5};
  expect_refusal(refusal("a.opdx", testing::OpdxExample{.kind = "Surface Height"}(values)),
                 "holds data of the kind \"Surface Height\"");
  expect_refusal(refusal("a.opdx", testing::OpdxExample{.unit = "V"}(values)), "which is no unit of length");
  expect_refusal(refusal("a.opdx", testing::OpdxExample{.extent = 0}(values)),
                 "gives 0 as `/1D_Data/Raw/Extent`");
  expect_refusal(refusal("a.opdx", testing::OpdxExample{.points = 6}(values)), "6 x 1 heights");
  expect_refusal(refusal("a.opdx", testing::OpdxExample{.points = 1}({1})), "holds one sample");
  const std::string whole = testing::OpdxExample{}(values);
  expect_refusal(refusal("a.opdx", whole.substr(0, 150)), "is cut short in its items");
  std::string deep = std::string("VCA DATA\x01\0\0\x55", 12);
  std::string inner;
  for (int k = 0; k < 40; ++k) inner = testing::opdx_container("a", inner);
  expect_refusal(refusal("a.opdx", deep + inner), "containers within containers");
}

TEST(ScanningProbe, DamageIsAnErrorOrAnotherSurface) {
  const std::vector<float> six{1, 2, 3, 4, 5, 6};
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.nid", testing::nid_example({{.name = "Deflection", .unit = "N"}, {}})},
      {"a.ibw", testing::IbwExample{.labels = {"Height"}}(six)},
      {"a.mi",
       testing::mi_example({{.label = "Friction", .unit = "V"}, {}}, raw(std::vector<std::int16_t>(12, 3)))},
      {"a.stp", testing::WsxmExample{.type = "float"}(raw(six))},
      {"a.tiff", testing::ParkExample{}(six)},
      {"a.opdx", testing::OpdxExample{}({1, 2, 3, 4, 5})},
  };
  for (const auto& file : files) {
    EXPECT_EQ(refusal(file.first, file.second), "no error");
    testing::damage(file.second, 61, 1000, [&](const std::string& damaged) { read(file.first, damaged); });
  }
}

}  // namespace
}  // namespace asperity::scanning_probe_test
