// SPDX-License-Identifier: GPL-3.0-or-later
// Carries out a protocol, one event per call. A failed event leaves the pair unchanged and is tried again.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "engine/contact/state.hpp"
#include "engine/core/monitor.hpp"
#include "engine/specimen/protocol.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity {

class ProtocolRun {
 public:
  // Throws the first predictable error (SpecimenPair::check_ahead).
  ProtocolRun(Protocol protocol, std::shared_ptr<SpecimenPair> pair);

  const Protocol& protocol() const { return protocol_; }
  SpecimenPair& pair() const { return *pair_; }
  bool finished() const { return next_ >= protocol_.count(); }
  // From 0.
  std::size_t next() const { return next_; }

  // Does the next event; returns the state of a press. Progress counts presses only. Throws as the pair does,
  // and Error{interrupted | time_limit | ...} before an event on a stop. Precondition: not finished().
  std::optional<State> step(Monitor& monitor = Monitor::silent());

 private:
  std::string title(std::size_t k) const;
  // Errors get the title of event k.
  template <class Work>
  void with_title(std::size_t k, const Work& work) const;

  Protocol protocol_;
  std::shared_ptr<SpecimenPair> pair_;
  std::size_t next_ = 0;
  std::size_t presses_ = 0, pressed_ = 0;
  std::chrono::steady_clock::time_point begun_;
};

}  // namespace asperity
