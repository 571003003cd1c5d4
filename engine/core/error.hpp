// SPDX-License-Identifier: GPL-3.0-or-later
// The engine's only exception type. The sentence states request and finding, the hint a valid alternative;
// the bindings add the script line. Both are plain text (plain_text in text.hpp), even if they quote
// arbitrary bytes.
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace asperity {

enum class ErrorCode {
  bad_value,      // a refused number, list or combination
  unknown_name,   // an unknown key, field, unit, material or method
  bad_unit,       // a unit of another dimension, or an unknown unit
  bad_file,       // a missing, damaged or unsuitable file
  infeasible,     // a well-posed request without solution (a load beyond capacity)
  not_converged,  // a solver stopped before its tolerance
  bad_state,      // a closed, empty or unready object
  not_permitted,  // forbidden in the safe environment
  out_of_memory,  // the machine's or the run's memory limit
  time_limit,     // the run's time limit
  interrupted,    // Ctrl-C
  internal,       // a bug
};

// "bad_value".
std::string_view name(ErrorCode code);

class Error : public std::exception {
 public:
  Error(ErrorCode code, std::string sentence, std::string hint = {});

  ErrorCode code() const { return code_; }
  const std::string& sentence() const { return sentence_; }
  const std::string& hint() const { return hint_; }
  // Sentence and hint joined by "; ".
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  ErrorCode code_;
  std::string sentence_;
  std::string hint_;
  std::string text_;
};

}  // namespace asperity
