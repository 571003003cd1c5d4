// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/json.hpp"

#include "tests/fuzz/target.hpp"

static void fuzz_json(const std::uint8_t* data, std::size_t size) {
  using namespace asperity;
  fuzz::refused(0, [&] {
    const Json value = Json::parse({reinterpret_cast<const char*>(data), size}, "input.json");
    const std::string text = value.text();
    fuzz::require(Json::parse(text, "text") == value, "a record reads back as it was written: " + text);
    fuzz::require(Json::parse(value.text(2), "text") == value, "also with line ends");
  });
}

static const asperity::fuzz::Target json_target{"json", fuzz_json};
