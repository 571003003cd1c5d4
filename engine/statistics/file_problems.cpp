// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/file_problems.hpp"

namespace asperity {

void FileProblems::add(const std::string& place, const std::string& finding) {
  constexpr std::size_t enough = 12;
  if (++count_ <= enough) sentences_.push_back(place + ": " + finding);
}

void FileProblems::fail_if_any() const {
  if (count_ == 0) return;
  if (count_ == 1) refuse_file(file_, sentences_.front());
  std::string finding = "has " + std::to_string(count_) + " problems";
  for (const std::string& text : sentences_) finding += "\n  " + text;
  if (count_ > sentences_.size())
    finding += "\n  and " + std::to_string(count_ - sentences_.size()) + " more";
  refuse_file(file_, finding);
}

}  // namespace asperity
