// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/confined_request.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"

namespace asperity::web::confined_request_test {
namespace {

ConfinedRequest arrived(const ConfinedRequest& request) {
  return confined_request(Json::parse(to_json(request).text(), "the request"));
}

TEST(ConfinedRequests, ArriveAsTheyWere) {
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
  ConfinedRequest request{.work = Work::command, .confinement = {}};
  request.command = {run, replay};
  const CarriedCommand there = arrived(request).command.value();
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
  request.command->replay.reset();
  EXPECT_FALSE(arrived(request).command.value().replay.has_value());
}

TEST(ConfinedRequests, RefuseCharactersThatAreNoBytes) {
  EXPECT_THROW(bytes_of("\xE2\x82\xAC"), Error);
  EXPECT_THROW(bytes_of("a\xC3"), Error);
  EXPECT_THROW(confined_request(Json::object()), Error);
}

}  // namespace
}  // namespace asperity::web::confined_request_test
