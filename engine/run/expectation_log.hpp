// SPDX-License-Identifier: GPL-3.0-or-later
// The verdicts of a run in order. Thread-safe.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "engine/core/files/json.hpp"
#include "engine/run/expectation.hpp"

namespace asperity {

Json to_json(const Verdict& verdict);

class ExpectationLog {
 public:
  void add(Verdict verdict);
  std::vector<Verdict> exchange(std::vector<Verdict> verdicts);
  std::vector<Verdict> verdicts() const;
  std::size_t failed() const;
  // "12 expectations hold (2 negative controls fail, as they should)", "3 of 12 expectations fail"; may be
  // "".
  std::string summary() const;

 private:
  mutable std::mutex mutex_;
  std::vector<Verdict> verdicts_;
};

}  // namespace asperity
