// SPDX-License-Identifier: GPL-3.0-or-later
// A log that can be written reads back as the same protocol.
#include "engine/recording/press_log.hpp"

#include "engine/core/files/source_file.hpp"
#include "tests/fuzz/target.hpp"

static void fuzz_press_log(const std::uint8_t* data, std::size_t size) {
  using namespace asperity;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  fuzz::ListeningMonitor monitor;
  fuzz::refused((std::size_t{1} << 16) + 64 * size, [&] {
    const Protocol protocol = read_press_log(SourceFile("log.csv", bytes), monitor);
    fuzz::require(protocol.count() > 0, "a protocol has events");
    fuzz::require(fuzz::is_plain_text(protocol.text()), "a protocol is shown as plain text");
    const std::string written = press_log_text(protocol);
    const Protocol again = read_press_log(SourceFile("log.csv", written));
    fuzz::require(again.digest() == protocol.digest(), "a log reads back as it was written:\n" + written);
  });
}

static const asperity::fuzz::Target press_log_target{"press_log", fuzz_press_log};
