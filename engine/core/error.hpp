// SPDX-License-Identifier: GPL-3.0-or-later
// The one exception type of the engine: a code, a sentence and a hint. The sentence says what was
// asked and what was found; the hint says what would work. The binding layer adds the script line.
// Both are plain text (plain_text in text.hpp), whatever bytes of a file or a script they repeat.
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace asperity {

enum class ErrorCode {
  bad_value,      // a number, list or combination outside what the call accepts
  unknown_name,   // a key, field, unit, material or method that does not exist
  bad_unit,       // a quantity whose unit has another dimension, or none that is known
  bad_file,       // a file that is missing, damaged, or not what it claims to be
  infeasible,     // a well-posed request with no solution (a load that cannot be carried)
  not_converged,  // a solver stopped before its tolerance
  bad_state,      // a call on something closed, empty or not ready
  not_permitted,  // something the safe environment does not allow
  out_of_memory,  // the machine's or the run's memory limit
  time_limit,     // the run's time limit
  interrupted,    // Ctrl-C
  internal,       // a broken promise of our own code
};

// One word for reports and tests, e.g. "bad_value".
std::string_view name(ErrorCode code);

class Error : public std::exception {
 public:
  Error(ErrorCode code, std::string sentence, std::string hint = {});

  ErrorCode code() const { return code_; }
  const std::string& sentence() const { return sentence_; }
  const std::string& hint() const { return hint_; }
  // Sentence and hint, joined by "; ".
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  ErrorCode code_;
  std::string sentence_;
  std::string hint_;
  std::string text_;
};

}  // namespace asperity
