// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/expectation.hpp"

#include <gtest/gtest.h>

namespace asperity::expectation_log_test {
namespace {

Verdict verdict(bool passed, bool should_fail = false) {
  Verdict v;
  v.passed = passed;
  v.should_fail = should_fail;
  v.notebook = "book";
  v.sentence = "said";
  return v;
}

TEST(ExpectationLog, SummaryCounts) {
  ExpectationLog log;
  EXPECT_EQ(log.summary(), "");
  log.add(verdict(true));
  EXPECT_EQ(log.summary(), "1 expectation holds");
  log.add(verdict(true, true));
  EXPECT_EQ(log.summary(), "2 expectations hold (1 negative control fails, as it should)");
  log.add(verdict(false));
  EXPECT_EQ(log.summary(), "1 of 3 expectations fails (1 negative control fails, as it should)");
  log.add(verdict(false, true));
  log.add(verdict(true, true));
  EXPECT_EQ(log.summary(), "2 of 5 expectations fail (2 negative controls fail, as they should)");
  EXPECT_EQ(log.failed(), 2U);
}

TEST(ExpectationLog, VerdictsBecomeRecords) {
  EXPECT_EQ(to_json(verdict(true)).text(), R"({"notebook":"book","passed":true,"sentence":"said"})");
  Verdict v = verdict(false, true);
  v.judged = false;
  v.label = "Fig. 8";
  EXPECT_EQ(
      to_json(v).text(),
      R"({"notebook":"book","passed":false,"judged":false,"should_fail":true,"label":"Fig. 8","sentence":"said"})");
}

}  // namespace
}  // namespace asperity::expectation_log_test
