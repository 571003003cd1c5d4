// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/error.hpp"

#include <utility>

#include "engine/core/text.hpp"

namespace asperity {

std::string_view name(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_value:
      return "bad_value";
    case ErrorCode::unknown_name:
      return "unknown_name";
    case ErrorCode::bad_unit:
      return "bad_unit";
    case ErrorCode::bad_file:
      return "bad_file";
    case ErrorCode::infeasible:
      return "infeasible";
    case ErrorCode::not_converged:
      return "not_converged";
    case ErrorCode::bad_state:
      return "bad_state";
    case ErrorCode::not_permitted:
      return "not_permitted";
    case ErrorCode::out_of_memory:
      return "out_of_memory";
    case ErrorCode::time_limit:
      return "time_limit";
    case ErrorCode::interrupted:
      return "interrupted";
    case ErrorCode::internal:
      return "internal";
  }
  return "internal";
}

Error::Error(ErrorCode code, std::string sentence, std::string hint)
    : code_(code), sentence_(plain_text(std::move(sentence))), hint_(plain_text(std::move(hint))) {
  text_ = hint_.empty() ? sentence_ : sentence_ + "; " + hint_;
}

}  // namespace asperity
