// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/error.hpp"

#include <array>
#include <utility>

#include "engine/core/text.hpp"

namespace asperity {

std::string_view name(ErrorCode code) {
  constexpr std::array<std::string_view, 12> names = {
      "bad_value", "unknown_name",  "bad_unit",      "bad_file",   "infeasible",  "not_converged",
      "bad_state", "not_permitted", "out_of_memory", "time_limit", "interrupted", "internal"};
  return names.at(static_cast<std::size_t>(code));
}

Error::Error(ErrorCode code, std::string sentence, std::string hint)
    : code_(code), sentence_(plain_text(std::move(sentence))), hint_(plain_text(std::move(hint))) {
  text_ = hint_.empty() ? sentence_ : sentence_ + "; " + hint_;
}

void refuse_state(std::string sentence, std::string hint) {
  throw Error(ErrorCode::bad_state, std::move(sentence), std::move(hint));
}

void refuse_name(std::string sentence, std::string hint) {
  throw Error(ErrorCode::unknown_name, std::move(sentence), std::move(hint));
}

void refuse_bad_file(std::string sentence, std::string hint) {
  throw Error(ErrorCode::bad_file, std::move(sentence), std::move(hint));
}

}  // namespace asperity
