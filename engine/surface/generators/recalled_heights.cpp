// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/recalled_heights.hpp"

#include "engine/core/digest.hpp"
#include "engine/core/files/result_store.hpp"

namespace asperity {

namespace {

const ResultForm<MadeHeights> form = {"heights of a surface",
                                      [](const MadeHeights& made, ResultFacts& facts, KeptFields& fields) {
                                        facts.numbers.emplace_back("scale", made.scale);
                                        facts.least_seconds = 1;
                                        fields = {{"heights", &made.heights}};
                                      },
                                      [](FoundResult& found) {
                                        return MadeHeights{found.take("heights"), found.number("scale")};
                                      }};

}  // namespace

MadeHeights recall_or_make(std::string_view generator, const std::function<std::string()>& key,
                           Monitor& monitor, const std::function<MadeHeights()>& make) {
  const auto whole = [&] { return Digester().add(form.call).add(generator).add(key()).hex(); };
  return recall_or(monitor, form, whole, make).result;
}

}  // namespace asperity
