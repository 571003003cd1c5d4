// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

#include "bindings/web/api/script_answers.hpp"
#include "bindings/web/confined/event_channel.hpp"
#include "bindings/web/runs/page_run.hpp"
#include "bindings/web/sandbox/frames.hpp"
#include "bindings/web/sandbox/plain_files.hpp"

namespace asperity::web::page_values_test {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "asperity-web-test-XXXXXX").string();
    EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
    path = pattern;
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

TEST(Positions, CountUnitsOfUtf16) {
  const std::string text = "aµ€𝛼b";  // 1, 1, 1, 2, 1 units; 1, 2, 3, 4, 1 bytes
  const std::size_t bytes[] = {0, 1, 3, 6, 6, 10, 11, 11};
  for (std::size_t unit = 0; unit < 8; ++unit) EXPECT_EQ(byte_of_unit(text, unit), bytes[unit]) << unit;
  const std::size_t units[] = {0, 1, 2, 2, 3, 3, 3, 5, 5, 5, 5, 6};
  for (std::size_t byte : {0, 1, 3, 6, 10, 11}) EXPECT_EQ(unit_of_byte(text, byte), units[byte]) << byte;
  EXPECT_EQ(byte_of_unit("", 5), 0U);
}

TEST(ReducedField, KeepsWhatIsSmallEnough) {
  Field field(256, 3);
  for (std::size_t k = 0; k < field.size(); ++k) field[k] = static_cast<double>(k);
  const ReducedField same = reduced(field);
  EXPECT_EQ(same.nx, 256);
  EXPECT_EQ(same.ny, 3);
  EXPECT_EQ(reduction_text(same, 256, 3), "none");
  for (std::size_t k = 0; k < field.size(); ++k) ASSERT_EQ(same.values[k], static_cast<float>(k));
}

TEST(ReducedField, IsTheMeanOfEachBlockAndOfFewerAtTheRim) {
  Field field(5, 3);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 5; ++i) field(i, j) = i + 10 * j;
  const ReducedField small = reduced(field, 3);
  EXPECT_EQ(small.nx, 3);
  EXPECT_EQ(small.ny, 3);
  EXPECT_EQ(small.block_x, 2);
  EXPECT_EQ(small.block_y, 1);
  EXPECT_EQ(small.values, (std::vector<float>{0.5F, 2.5F, 4, 10.5F, 12.5F, 14, 20.5F, 22.5F, 24}));
  EXPECT_EQ(reduction_text(small, 5, 3), "mean of 2 x 1 nodes, fewer at the far edges");
}

TEST(ReducedField, KeepsTheMeanOfAGridOfWholeBlocks) {
  Field field(512, 768);
  double sum = 0, mean_of_blocks = 0;
  for (std::size_t k = 0; k < field.size(); ++k) sum += field[k] = std::sin(static_cast<double>(k));
  const ReducedField small = reduced(field);
  EXPECT_EQ(small.nx, 256);
  EXPECT_EQ(small.ny, 256);
  EXPECT_EQ(small.block_y, 3);
  for (const float value : small.values) mean_of_blocks += value;
  EXPECT_NEAR(mean_of_blocks / 65536, sum / static_cast<double>(field.size()), 1e-8);
  EXPECT_EQ(reduction_text(small, 512, 768), "mean of 2 x 3 nodes");
}

TEST(ReducedField, SaysSoWhereTheLastBlockIsSmaller) {
  const Field field(514, 512, 1.0);
  const ReducedField small = reduced(field);
  EXPECT_EQ(small.nx, 172);  // 171 blocks of 3 and one of 1
  EXPECT_EQ(reduction_text(small, 514, 512), "mean of 3 x 2 nodes, fewer at the far edges");
  for (const float value : small.values) ASSERT_EQ(value, 1.0F);
}

TEST(ReducedField, HolesOfASurfaceAreMissing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Field heights(3, 2, 1e-6);
  heights(1, 1) = nan;
  const Grid grid = make_grid(3, 2, 3e-6, 2e-6);
  const Json holed = to_json(view_of(Surface::with_holes(grid, heights), "map"));
  const Json* const field = &holed.find("fields")->list()[0];
  EXPECT_EQ(field->find("not_measured")->number(), 1);
  const float height = 1e-6F;
  std::vector<float> values{height, height, height, height, static_cast<float>(nan), height};
  EXPECT_EQ(field->find("data")->string(),
            base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)}));
  const Json whole = to_json(view_of(Surface(grid, Field(3, 2)), "map"));
  EXPECT_EQ(whole.find("fields")->list()[0].find("not_measured"), nullptr);
  // The mean of the measured points.
  Field wide(4, 1, 2.0);
  wide(0, 0) = wide(2, 0) = wide(3, 0) = nan;
  const ReducedField small = reduced(wide, 2);
  EXPECT_EQ(small.values[0], 2.0F);
  EXPECT_TRUE(std::isnan(small.values[1]));
}

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

TEST(PlainFile, IsFollowedThroughNoLink) {
  const Folder folder;
  fs::create_directories(folder.path / "in/side");
  std::ofstream(folder.path / "in/side/a.csv") << "12345";
  std::ofstream(folder.path / "outside") << "secret";
  fs::create_symlink(folder.path / "outside", folder.path / "in/link");
  fs::create_directory_symlink(folder.path, folder.path / "in/up");
  ASSERT_EQ(::mkfifo((folder.path / "in/pipe").c_str(), 0600), 0);
  EXPECT_EQ(read_plain_file(folder.path / "in", "side/a.csv", 5), "12345");
  EXPECT_FALSE(read_plain_file(folder.path / "in", "side/a.csv", 4));
  for (const char* name : {"", ".", "..", "../outside", "side/../../outside", "link", "up/outside", "pipe",
                           "side", "side/", "/etc/passwd", "side//a.csv", "./side/a.csv", "nothing"})
    EXPECT_FALSE(read_plain_file(folder.path / "in", name, 100)) << name;
  std::int64_t bytes = 0;
  const auto files = plain_files(folder.path / "in", 100, bytes);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].name, "side/a.csv");
  EXPECT_GE(bytes, 5);
  plain_files(folder.path / "in", 2, bytes);
  EXPECT_EQ(bytes, too_many);
}

TEST(EventLog, GivesWhatComesAfterANumber) {
  const Folder folder;
  EventLog log(folder.path / "events");
  EXPECT_TRUE(log.add("output", Json::object({{"text", "one"}})));
  EXPECT_TRUE(log.add("row", Json::object({{"n", 7}, {"type", "finished"}})));
  std::int64_t after = 0;
  bool more = false;
  EXPECT_EQ(log.after(after, std::chrono::milliseconds(0), more),
            "{\"n\":1,\"type\":\"output\",\"text\":\"one\"}\n{\"n\":2,\"type\":\"row\"}\n");
  EXPECT_EQ(after, 2);
  EXPECT_TRUE(more);
  EXPECT_EQ(log.after(after, std::chrono::milliseconds(1), more), "");
  log.finish(Json::object());
  EXPECT_FALSE(log.add("output", Json::object()));
  EXPECT_EQ(log.after(after, std::chrono::milliseconds(0), more), "{\"n\":3,\"type\":\"finished\"}\n");
  EXPECT_FALSE(more);
  after = 99;
  EXPECT_EQ(log.after(after, std::chrono::milliseconds(0), more), "");
  EXPECT_FALSE(more);
}

// Once its end is announced, a run is not listed as running.
TEST(PageRun, HasEndedForWhomeverHearsOfItsEnd) {
  const Folder folder;
  for (int repeat = 0; repeat < 200; ++repeat) {
    PageRun run(std::to_string(repeat), 0, {}, folder.path / std::to_string(repeat));
    std::thread ends([&] { run.give_up(RunState::stopped, "it was stopped before it began"); });
    std::string told;
    std::int64_t after = 0;
    for (bool more = true; more;) told += run.events.after(after, std::chrono::seconds(10), more);
    EXPECT_EQ(run.state(), RunState::stopped) << repeat;
    ends.join();
    EXPECT_NE(told.find("\"finished\""), std::string::npos);
  }
}

TEST(Frame, ComesAsItWentAndNotLonger) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string zero("a\0b", 3);
  const std::string_view texts[] = {"", zero};
  ASSERT_TRUE(send_frame(ends[1], texts));
  const auto back = receive_frame(ends[0], 3);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, (std::vector<std::string>{"", zero}));
  ASSERT_TRUE(send_frame(ends[1], texts));
  EXPECT_FALSE(receive_frame(ends[0], 2));
  ::close(ends[1]);
  while (receive_frame(ends[0], 100)) {
  }
  ::close(ends[0]);
}

}  // namespace
}  // namespace asperity::web::page_values_test
