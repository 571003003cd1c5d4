// SPDX-License-Identifier: GPL-3.0-or-later
// A protocol under way on a specimen pair, one event a call. An event that fails leaves the pair as it was
// before that event, and the next call tries the same event again. Events that no call asks for are not done.
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

// Several runs may share a protocol, and take turns on one pair.
class ProtocolRun {
 public:
  // Throws for the first event with an error that is known in advance (SpecimenPair::check_ahead) and names
  // the event.
  ProtocolRun(Protocol protocol, std::shared_ptr<SpecimenPair> pair);

  const Protocol& protocol() const { return protocol_; }
  SpecimenPair& pair() const { return *pair_; }
  bool finished() const { return next_ >= protocol_.count(); }
  // The number of the next event, from 0.
  std::size_t next() const { return next_; }

  // Does the next event: the state of a press, nothing for any other kind. Tells the monitor how much of
  // the whole protocol is done, where presses count alike and all else counts nothing. Throws what the pair
  // throws, and Error{interrupted | time_limit | ...} before an event when a stop was asked for; the
  // sentence names event and step. Precondition: not finished().
  std::optional<State> step(Monitor& monitor = Monitor::silent());

 private:
  std::string title(std::size_t k) const;
  // Calls `step`; an error gets the title of event k.
  template <class Work>
  void with_title(std::size_t k, const Work& work) const;

  Protocol protocol_;
  std::shared_ptr<SpecimenPair> pair_;
  std::size_t next_ = 0;
  std::size_t presses_ = 0, pressed_ = 0;
  std::chrono::steady_clock::time_point begun_;
};

}  // namespace asperity
