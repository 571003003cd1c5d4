// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/write.hpp"

#include <sys/stat.h>

#include <cmath>
#include <limits>

#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"

namespace asperity::write_test {
namespace {

using testing::message_of;
using testing::Scratch;

Surface awkward(int nx, int ny, double size_x, double size_y) {
  Field heights(nx, ny);
  const Stream stream(3, "heights");
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = stream.normal(k) * 1e-7 / 3;
  heights[0] = -0.0;
  if (heights.size() > 1) heights[1] = std::numeric_limits<double>::denorm_min();
  if (heights.size() > 2) heights[2] = std::numeric_limits<double>::max() / 4;
  return Surface(make_grid(nx, ny, size_x, size_y), std::move(heights));
}

TEST(Write, DevicesAndPipesStayWhatTheyAre) {
  const Scratch scratch;
  const std::string pipe = scratch.path("pipe.npy");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(message_of([&] {
              write_surface(Surface(Grid{1, 1, 1, 1}, Field(1, 1)), pipe);
            }),
            "\"" + pipe + "\" is not a plain file; give the name of one");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(Write, SurfacesReadBackBitForBit) {
  const Scratch scratch;
  for (const double size_x : {1e-4 / 3, 0.1, 7.3e-6, 8.29767313942749e-05, 1.7976931348623157e300}) {
    for (const auto& [nx, ny] : {std::pair{7, 5}, {1, 1}, {1, 4}, {13, 1}, {49, 3}, {650, 2}}) {
      const Surface surface = awkward(nx, ny, size_x, size_x / 7);
      for (const char* name : {"a.x3p", "a.txt", "a.csv", "a.asc", "a.npy"}) {
        write_surface(surface, scratch.path(name));
        ReadOptions options;
        if (std::string(name) == "a.npy") {
          options.size_x = surface.grid().size_x;
          options.size_y = surface.grid().size_y;
          options.unit = 1;
        }
        const Surface back = read_surface(scratch.path(name), options);
        EXPECT_EQ(back.digest(), surface.digest()) << name << " " << nx << " x " << ny << ", " << size_x;
        EXPECT_TRUE(std::signbit(back.height(0, 0))) << name;
      }
    }
  }
  EXPECT_EQ(scratch.entries(), 5U);  // no temporary file remains
}

TEST(Write, ThreeColumnsWithOwnHeaderStayAMatrix) {
  const Scratch scratch;
  Field heights(3, 4);
  const double lattice[] = {0, 0, 1, 0, 1, 1, 1, 0, 2, 1, 1, 3};
  std::copy(std::begin(lattice), std::end(lattice), heights.values().begin());
  const Surface surface(make_grid(3, 4, 1e-3, 1e-3), heights);
  write_surface(surface, scratch.path("lattice.txt"));
  EXPECT_EQ(read_surface(scratch.path("lattice.txt")).digest(), surface.digest());
}

TEST(Write, ProfilesReadBackBitForBit) {
  const Scratch scratch;
  const Stream stream(9, "trace");
  Array<double> heights(1001);
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = stream.normal(k) * 1e-6;
  for (const Profile& profile :
       {Profile(0.1e-6 / 3, heights), Profile(1e-6, heights, 2.5e-3), Profile(1.0, {4.0})}) {
    for (const char* name : {"p.csv", "p.txt"}) {
      write_profile(profile, scratch.path(name));
      EXPECT_EQ(read_profile(scratch.path(name)).digest(), profile.digest()) << name;
    }
    write_profile(profile, scratch.path("p.npy"));
    ReadProfileOptions options;
    options.spacing = profile.spacing();
    options.unit = 1;
    const Profile back = read_profile(scratch.path("p.npy"), options);
    EXPECT_TRUE(std::equal(back.heights().begin(), back.heights().end(), profile.heights().begin(),
                           profile.heights().end()));
  }
}

TEST(Write, SameBytesEveryTime) {
  const Scratch scratch;
  const Surface surface = awkward(9, 8, 1e-3, 2e-3);
  for (const std::string name : {"s.x3p", "s.npy", "s.txt"}) {
    write_surface(surface, scratch.path("1" + name));
    write_surface(surface, scratch.path("2" + name));
    EXPECT_EQ(testing::bytes_of(scratch.path("1" + name)), testing::bytes_of(scratch.path("2" + name)))
        << name;
  }
}

TEST(Write, NpyDataStartAligned) {
  const Scratch scratch;
  write_surface(awkward(4, 3, 1, 1), scratch.path("a.npy"));
  EXPECT_EQ(testing::bytes_of(scratch.path("a.npy")).size(), 128U + 96U);
}

TEST(Write, PathsThatCannotBeWritten) {
  const Scratch scratch;
  const Surface surface = awkward(2, 2, 1, 1);
  EXPECT_EQ(message_of([&] { write_surface(surface, "map.stl"); }),
            "cannot write \"map.stl\": no format has the extension .stl; use .h5, .npy, .x3p, .gwy, .sdf, "
            ".sur, .txt, .asc or .csv");
  EXPECT_NE(message_of([&] { write_surface(surface, "map"); }).find("has no extension"), std::string::npos);
  EXPECT_NE(message_of([&] { write_profile(Profile(1, {0.0}), "p.x3p"); }).find("use .csv, .txt or .npy"),
            std::string::npos);
  for (const char* name : {"no/such/map.txt", "no/such/map.x3p"})
    EXPECT_NE(message_of([&] { write_surface(surface, scratch.path(name)); }).find("there is no directory"),
              std::string::npos);
  std::filesystem::create_directory(scratch.path("taken.txt"));
  EXPECT_NE(message_of([&] { write_surface(surface, scratch.path("taken.txt")); }).find("is a directory"),
            std::string::npos);
  EXPECT_EQ(scratch.entries(), 1U);
}

TEST(Write, FailureLeavesWhatWasThere) {
  const Scratch scratch;
  const std::string path = scratch.write("keep.npy", "old");
  class Stop : public Monitor {
   public:
    void progress(std::string_view, double) override {}
    void warn(std::string_view) override {}
  } monitor;
  stop_flag().raise(StopReason::interrupt);
  const auto error = testing::error_of([&] { write_surface(awkward(4, 4, 1, 1), path, monitor); });
  stop_flag().clear();
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::interrupted);
  EXPECT_EQ(testing::bytes_of(path), "old");
  EXPECT_EQ(scratch.entries(), 1U);
}

}  // namespace
}  // namespace asperity::write_test
