// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/core/files/source_file.hpp"

namespace asperity {

class FileProblems {
 public:
  explicit FileProblems(const SourceFile& file) : file_(file) {}
  // "line 3, column 2 (load)": "\"x\" is no finite number".
  void add(const std::string& place, const std::string& finding);
  std::size_t count() const { return count_; }
  // Throws Error{bad_file} with the first dozen problems.
  void fail_if_any() const;

 private:
  const SourceFile& file_;
  std::vector<std::string> sentences_;
  std::size_t count_ = 0;
};

}  // namespace asperity
