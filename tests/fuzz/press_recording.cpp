// SPDX-License-Identifier: GPL-3.0-or-later
// The detected protocol, written as a press log, reads back equal.
#include "engine/recording/press_recording.hpp"

#include "engine/core/files/source_file.hpp"
#include "engine/recording/event_detection.hpp"
#include "engine/recording/press_log.hpp"
#include "tests/fuzz/target.hpp"

static void fuzz_press_recording(const std::uint8_t* data, std::size_t size) {
  using namespace asperity;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  fuzz::ListeningMonitor monitor;
  fuzz::refused((std::size_t{1} << 16) + 256 * size, [&] {
    const SourceFile file("log.csv", bytes);
    looks_like_recording(file);
    const PressRecording recording = read_press_recording(file, monitor);
    fuzz::require(recording.time.size() == recording.load.size(), "a load or a hole for every time");
    const Protocol protocol = detect_events(recording, {}, monitor);
    fuzz::require(protocol.count() > 0, "a protocol has events");
    fuzz::require(fuzz::is_plain_text(protocol.text() + protocol.recording()->text()), "shown as plain text");
    double last = -1e308;
    for (const Protocol::Event& event : protocol.events()) {
      fuzz::require(event.time.has_value() && *event.time >= last, "events come one after the other");
      last = *event.time;
      if (const auto* press = std::get_if<PressRequest>(&event.step))
        fuzz::require(press->value > 0 && press->dwell && *press->dwell >= 0,
                      "a press has a load and a dwell");
    }
    const std::string written = press_log_text(protocol);
    const Protocol again = read_press_log(SourceFile("log.csv", written));
    fuzz::require(again.digest() == protocol.digest(), "a log reads back as it was written:\n" + written);
  });
}

static const asperity::fuzz::Target press_recording_target{"press_recording", fuzz_press_recording};
