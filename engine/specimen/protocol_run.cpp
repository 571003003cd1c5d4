// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/specimen/protocol_run.hpp"

#include <string>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/part_monitor.hpp"

namespace asperity {

namespace {

struct Doer {
  SpecimenPair& pair;
  Monitor& monitor;
  std::optional<State> operator()(const PressRequest& s) const { return pair.press(s, monitor); }
  std::optional<State> operator()(const Protocol::Release&) const { return pair.release(), std::nullopt; }
  std::optional<State> operator()(const Protocol::Place& s) const { return pair.place(s.seed), std::nullopt; }
  std::optional<State> operator()(const Protocol::Rotate& s) const {
    return pair.rotate(s.angle), std::nullopt;
  }
  std::optional<State> operator()(const Protocol::Shift& s) const {
    return pair.shift(s.x, s.y), std::nullopt;
  }
};

}  // namespace

ProtocolRun::ProtocolRun(Protocol protocol, std::shared_ptr<SpecimenPair> pair)
    : protocol_(std::move(protocol)),
      pair_(std::move(pair)),
      presses_(protocol_.presses()),
      begun_(std::chrono::steady_clock::now()) {
  Pose lying = pair_->pose();
  for (std::size_t k = 0; k < protocol_.count(); ++k)
    with_title(k, [&] { pair_->check_ahead(protocol_.events()[k].step, lying); });
}

std::string ProtocolRun::title(std::size_t k) const {
  return "event " + std::to_string(k + 1) + " of " + std::to_string(protocol_.count()) + ": " +
         text(protocol_.events()[k].step);
}

template <class Work>
void ProtocolRun::with_title(std::size_t k, const Work& work) const {
  try {
    work();
  } catch (const Error& error) {
    const std::string& origin = protocol_.events()[k].origin;
    throw Error(error.code(),
                title(k) + (origin.empty() ? "" : " (" + origin + ")") + ": " + error.sentence(),
                error.hint());
  }
}

std::optional<State> ProtocolRun::step(Monitor& monitor) {
  const Protocol::Event& event = protocol_.events()[next_];
  std::optional<State> state;
  with_title(next_, [&] {
    stop_flag().check();
    const bool press = std::holds_alternative<PressRequest>(event.step);
    const double all = presses_ == 0 ? 1 : static_cast<double>(presses_);
    const double before = static_cast<double>(pressed_) / all;
    const double after = static_cast<double>(pressed_ + (press ? 1 : 0)) / all;
    PartMonitor part(monitor, "protocol", title(next_), before, after, begun_);
    part.begin();
    const std::size_t done = pair_->history().size();
    state = std::visit(Doer{*pair_, part}, event.step);
    pair_->date(done, event.time);
    if (press) ++pressed_;
    ++next_;
  });
  return state;
}

}  // namespace asperity
