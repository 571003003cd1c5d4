// SPDX-License-Identifier: GPL-3.0-or-later
// Every reader must return or throw an Error with a printable message, use counted memory up to a fixed
// multiple of the input, and release all. A violation aborts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::fuzz {

// A reader and its preparation. A static Target in each source registers itself (program.cpp).
struct Target {
  using Run = void (*)(const std::uint8_t* data, std::size_t size);
  using Prepare = void (*)();
  Target(const char* its_name, Run runs, Prepare prepares = nullptr);
  const char* name;
  Run run;
  Prepare prepare;
};

inline void require(bool holds, const std::string& promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise.c_str());
  std::abort();
}

// UTF-8 without control characters other than tabs and line ends.
inline bool is_plain_text(std::string_view text) {
  for (std::size_t k = 0; k < text.size();) {
    const auto lead = static_cast<unsigned char>(text[k]);
    const std::size_t more = lead < 0x80 ? 0 : lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : 1;
    if ((lead < 0x20 && lead != '\n' && lead != '\t') || lead == 0x7F) return false;
    if ((lead >= 0x80 && lead < 0xC2) || lead > 0xF4 || k + more >= text.size()) return false;
    for (std::size_t b = 1; b <= more; ++b)
      if ((static_cast<unsigned char>(text[k + b]) & 0xC0) != 0x80) return false;
    k += more + 1;
  }
  return true;
}

inline void require_good_message(const std::string& message) {
  require(!message.empty() && is_plain_text(message), "a message is plain text: " + message);
}

class ListeningMonitor final : public Monitor {
 public:
  void progress(std::string_view, double done) override {
    require(done >= 0 && done <= 1, "a share is done");
  }
  void warn(std::string_view sentence) override { require_good_message(std::string(sentence)); }
};

// Runs read() with at most `room` more bytes of counted memory; `kept` bytes may remain. Returns whether
// read() threw.
template <class Read>
bool refused(std::size_t room, Read&& read, std::int64_t kept = 0) {
  const std::int64_t before = memory::held();
  memory::set_limit(before + static_cast<std::int64_t>(room));
  bool threw = false;
  try {
    read();
  } catch (const Error& error) {
    threw = true;
    require_good_message(error.what());
    require(error.code() != ErrorCode::out_of_memory,
            std::string("memory is bounded by the input: ") + error.what());
    require(error.code() != ErrorCode::internal, std::string("no internal error: ") + error.what());
  }
  memory::set_limit(0);
  require(memory::held() <= before + kept, "all memory is given back");
  return threw;
}

}  // namespace asperity::fuzz
