// SPDX-License-Identifier: GPL-3.0-or-later
// The engine's only exception. The sentence states request and finding, the hint a valid alternative; the
// bindings add the script line. Both are plain_text (text.hpp).
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace asperity {

enum class ErrorCode {
  bad_value,
  unknown_name,  // an unknown key, field, unit, material or method
  bad_unit,      // a unit of another dimension, or an unknown unit
  bad_file,
  infeasible,  // a well-posed request without solution (a load beyond capacity)
  not_converged,
  bad_state,  // a closed, empty or unready object
  not_permitted,
  out_of_memory,  // of the machine or the run
  time_limit,
  interrupted,  // Ctrl-C
  internal,     // a bug
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

[[noreturn]] void refuse_state(std::string sentence, std::string hint = {});
[[noreturn]] void refuse_name(std::string sentence, std::string hint = {});
[[noreturn]] void refuse_bad_file(std::string sentence, std::string hint = {});

}  // namespace asperity
