// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/result_store.hpp"

#include <algorithm>

#include "engine/core/text.hpp"

namespace asperity {

namespace {

template <class List>
auto& of_name(List& list, std::string_view name) {
  const auto found = std::ranges::find_if(list, [&](const auto& entry) { return entry.first == name; });
  if (found == list.end())
    throw Error(ErrorCode::internal, "a stored result has no " + quoted(name), "please report this");
  return found->second;
}

}  // namespace

double FoundResult::number(std::string_view name) const { return of_name(numbers, name); }
const std::string& FoundResult::text(std::string_view name) const { return of_name(texts, name); }
Field FoundResult::take(std::string_view name) { return std::move(of_name(fields, name)); }
KeptFields FoundResult::kept() const {
  KeptFields all;
  for (const auto& [name, field] : fields) all.emplace_back(name, &field);
  return all;
}

}  // namespace asperity
