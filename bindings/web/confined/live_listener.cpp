// SPDX-License-Identifier: GPL-3.0-or-later
#include <poll.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "bindings/cli/disk_bound.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/web/confined/live_script.hpp"
#include "bindings/web/sandbox/frames.hpp"
#include "engine/core/error.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::web {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t longest_question = std::size_t{1} << 20;

// The newest question, and the run that it may interrupt.
class Questions final : public KnobAsker {
 public:
  explicit Questions(int socket) : socket_(socket), listener_([this] { listen(); }) { listener_.detach(); }

  // Blocks.
  KnobQuestion next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.has_value(); });
    return *std::exchange(waiting_, std::nullopt);
  }
  bool newer() override {
    const std::lock_guard lock(mutex_);
    return waiting_.has_value();
  }

  void watch(lua_State* L, Clock::time_point makes_way) override {
    const std::lock_guard lock(mutex_);
    state_ = L;
    makes_way_ = makes_way;
  }
  void send(const Json& answer, const std::vector<std::vector<float>>& fields) override {
    const std::string text = answer.text();
    std::vector<std::string_view> texts{text};
    for (const auto& field : fields)
      texts.emplace_back(reinterpret_cast<const char*>(field.data()), field.size() * sizeof(float));
    if (!send_frame(socket_, texts)) std::_Exit(0);
  }

 private:
  void listen() {
    for (;;) {
      pollfd watched{socket_, POLLIN, 0};
      if (::poll(&watched, 1, pause()) > 0) {
        const auto texts = receive_frame(socket_, longest_question);
        if (!texts || texts->size() != 1) std::_Exit(0);  // the asker has left
        try {
          KnobQuestion question = knob_question(texts->front());
          const std::lock_guard lock(mutex_);
          waiting_ = std::move(question);
          changed_.notify_one();
        } catch (const Error&) {
          std::_Exit(1);
        }
      }
      const std::lock_guard lock(mutex_);
      if (!waiting_ || state_ == nullptr || Clock::now() < makes_way_) continue;
      stop_flag().raise(StopReason::interrupt);
      lua::interrupt(state_);
      state_ = nullptr;
    }
  }

  // Milliseconds until the run yields; -1: no limit.
  int pause() {
    const std::lock_guard lock(mutex_);
    if (!waiting_ || state_ == nullptr) return -1;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(makes_way_ - Clock::now());
    return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 10000));
  }

  const int socket_;
  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::optional<KnobQuestion> waiting_;
  lua_State* state_ = nullptr;
  Clock::time_point makes_way_;
  std::thread listener_;
};

}  // namespace

int run_as_knobs_move(const ConfinedRequest& request, int socket) {
  const cli::UnlinkedFilesBound unlinked(request.confinement.file_bytes);
  Questions questions(socket);
  const auto answer = live_script(request, questions);
  for (;;) answer(questions.next());
}

}  // namespace asperity::web
