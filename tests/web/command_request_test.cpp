// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/command_request.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"

namespace asperity::web::command_request_test {
namespace {

TEST(CommandRequest, ArrivesAsItWas) {
  std::string every;
  for (int byte = 0; byte < 256; ++byte) every += static_cast<char>(byte);
  cli::RunCommand run;
  run.script = "a " + every;
  run.text = every + every;
  run.seed = 999'999'999'999'999'999U;
  run.arguments = {"", every, "x=1"};
  run.store = "s";
  run.store_limit = (std::int64_t{1} << 62) - 1;
  run.limit_disk = 12345;
  run.limit_time = 0.1;
  run.shard = Shard{2, 3};
  run.reuse = {"one", "two"};
  run.barriers = Json::object({{"read", Json::List()}});
  cli::ReplayCommand replay;
  replay.recorded = "runs/\xC3\xA9";
  replay.from = 7;
  replay.settings = {"press.pressure=\"1 MPa\""};
  const CarriedCommand there = command_of(Json::parse(command_json(run, &replay).text(), "the command"));
  EXPECT_EQ(there.run.script, run.script);
  EXPECT_EQ(there.run.text, run.text);
  EXPECT_EQ(there.run.seed, run.seed);
  EXPECT_EQ(there.run.arguments, run.arguments);
  EXPECT_EQ(there.run.store, run.store);
  EXPECT_EQ(there.run.store_limit, run.store_limit);
  EXPECT_EQ(there.run.limit_disk, 12345);
  EXPECT_EQ(there.run.limit_time, run.limit_time);
  EXPECT_EQ(there.run.out, std::nullopt);
  ASSERT_TRUE(there.run.shard.has_value());
  EXPECT_EQ(there.run.shard->index, 2);
  EXPECT_EQ(there.run.shard->count, 3);
  EXPECT_EQ(there.run.reuse, run.reuse);
  EXPECT_EQ(there.run.barriers, run.barriers);
  ASSERT_TRUE(there.replay.has_value());
  EXPECT_EQ(there.replay->recorded, replay.recorded);
  EXPECT_EQ(there.replay->from, 7);
  EXPECT_EQ(there.replay->settings, replay.settings);
  EXPECT_FALSE(command_of(Json::parse(command_json(run, nullptr).text(), "the command")).replay.has_value());
}

TEST(CommandRequest, RefusesCharactersThatAreNoBytes) {
  EXPECT_THROW(bytes_of("\xE2\x82\xAC"), Error);
  EXPECT_THROW(bytes_of("a\xC3"), Error);
  EXPECT_THROW(command_of(Json::object()), Error);
}

}  // namespace
}  // namespace asperity::web::command_request_test
