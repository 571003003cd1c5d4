// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/live_sessions.hpp"

#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <limits>
#include <utility>

#include "bindings/web/sandbox/frames.hpp"
#include "engine/core/error.hpp"

namespace asperity::web {

namespace {

constexpr std::size_t longest_answer = std::size_t{8} << 20;
constexpr auto turn_patience = std::chrono::seconds(8);

std::string frame_of(const Json& json) {
  const std::string text = json.text();
  const std::string_view texts[] = {text};
  return frame(texts);
}

}  // namespace

LiveSession::LiveSession(std::string name, std::size_t of, std::string in, const RunRequest& request,
                         const LiveSetup& setup)
    : id(std::move(name)),
      owner(of),
      tab(std::move(in)),
      request_(confined_request(Work::live, request, setup.limits, setup.barriers)),
      folder_(private_folder(setup.folder / ("live-" + id))),
      setup_(setup),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  thread_ = std::thread([this] { work(); });
}

LiveSession::~LiveSession() {
  end("it was ended");
  thread_.join();
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void LiveSession::end(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (why_.empty()) why_ = why;
  ::eventfd_write(wake_.get(), 1);
}

bool LiveSession::busy() const {
  const std::lock_guard lock(mutex_);
  return share_ != nullptr;
}

LiveSession::Clock::time_point LiveSession::last_used() const {
  const std::lock_guard lock(mutex_);
  return used_;
}

std::int64_t LiveSession::move(const GivenKnobs& knobs, const std::string& view, const std::string& map,
                               std::shared_ptr<void> share) {
  Json given = Json::object();
  for (const auto& [name, text] : knobs) given.set(name, text);
  const std::lock_guard lock(mutex_);
  if (share != nullptr) share_ = std::move(share);
  used_ = Clock::now();
  question_ =
      Json::object({{"move", ++moves_}, {"knobs", std::move(given)}, {"view", view}, {"map", map}}).text();
  ::eventfd_write(wake_.get(), 1);
  return moves_;
}

bool LiveSession::answer(std::int64_t move, std::string& piece, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  const auto mine = [&] { return std::ranges::find(pieces_, move, &Piece::move); };
  changed_.wait_for(lock, patience,
                    [&] { return over_.load() || answered_ > move || mine() != pieces_.end(); });
  if (const auto found = mine(); found != pieces_.end()) {
    piece = std::move(found->frame);
    const bool last = found->last;
    pieces_.erase(found);
    return !last;
  }
  if (answered_ > move) {
    piece = frame_of(Json::object({{"move", move}, {"part", "outdated"}}));
    return false;
  }
  if (!over_.load()) return true;
  piece = frame_of(Json::object({{"move", move}, {"part", "ended"}, {"why", why_}}));
  return false;
}

// Follows the process of a session: passes on questions and answers.
class LiveFollower final : public Follower {
 public:
  LiveFollower(LiveSession& session, FollowBounds bounds)
      : Follower(session.request_, bounds.directory.string(), bounds), session_(session) {
    // A hostile process that never reads must not block this thread.
    const timeval most{1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &most, sizeof most);
    also_watched_ = {{socket_, POLLIN, 0}, {session.wake_.get(), POLLIN, 0}};
  }

  // Returns the reason of the end.
  std::string follow_to_end() {
    follow();
    take_answers();
    if (!ended_for_.empty()) return ended_for_;
    return last_words_.empty() ? "the script's process ended" : "the script's process ended: " + last_words_;
  }

 private:
  // Keeps the last lines of output, which explain a crash.
  void take(const Descriptor& from, std::string_view piece) override {
    if (&from != &process_.error) return;
    last_words_ += piece;
    if (last_words_.size() > 2000) last_words_.erase(0, last_words_.size() - 2000);
  }

  void look(Clock::time_point now) override {
    eventfd_t count = 0;
    if (::eventfd_read(session_.wake_.get(), &count) == 0) ask();
    if (!take_answers()) process_.send(SIGKILL);
    if (now - session_.last_used() > session_.setup_.idle) end("no knob was moved for a while");
    const std::lock_guard lock(session_.mutex_);
    if (!session_.why_.empty()) end(session_.why_);
  }

  void ask() {
    std::string question;
    {
      const std::lock_guard lock(session_.mutex_);
      question = std::exchange(session_.question_, {});
    }
    const std::string_view texts[] = {question};
    if (!question.empty() && !send_frame(socket_, texts)) end("the script's process took no question");
  }

  // False if the process has ended or its answer is invalid. Never blocks.
  bool take_answers() {
    bool there = true;  // last answers count
    char piece[65536];
    for (int most = 64; there && most > 0; --most) {
      const ssize_t got = ::recv(socket_, piece, sizeof piece, MSG_DONTWAIT);
      there = got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
      if (got <= 0) break;
      arrived_.append(piece, static_cast<std::size_t>(got));
      try {
        while (const auto texts = take_frame(arrived_, longest_answer)) session_.take(*texts);
      } catch (const Error&) {
        return false;
      }
    }
    return there;
  }

  LiveSession& session_;
  const int socket_ = process_.drawing.get();
  std::string arrived_, last_words_;  // incomplete answer; standard error
};

void LiveSession::work() {
  try {
    // In this thread: the process dies with it.
    LiveFollower follower(*this, {.seconds = std::numeric_limits<double>::infinity(),
                                  .to_end = {},
                                  .pause = std::chrono::seconds(1),
                                  .directory = folder_,
                                  .directory_bytes = setup_.limits.directory_bytes,
                                  .files = setup_.limits.files});
    finish(follower.follow_to_end());
  } catch (const std::exception& error) {
    finish(error.what());
  }
}

// Throws Error{bad_file}.
void LiveSession::take(const std::vector<std::string>& texts) {
  const Json json = Json::parse(texts.empty() ? std::string() : texts.front(), "an answer");
  const double told = json["move"].number();
  const bool last = json["part"].string() != "coarse" && json.find("first") == nullptr;
  const std::vector<std::string_view> all(texts.begin(), texts.end());
  const std::lock_guard lock(mutex_);
  if (!(told > static_cast<double>(answered_) && told <= static_cast<double>(moves_))) return;
  const auto move = static_cast<std::int64_t>(told);
  std::erase_if(pieces_, [&](const Piece& piece) { return piece.move < move && !piece.last; });
  pieces_.push_back({move, frame(all), last});
  while (pieces_.size() > 4) pieces_.pop_front();
  if (last) answered_ = move;
  if (answered_ == moves_) share_.reset();
  used_ = Clock::now();
  changed_.notify_all();
}

void LiveSession::finish(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (why_.empty()) why_ = why;
  over_.store(true);
  share_.reset();
  changed_.notify_all();
}

LiveSessions::LiveSessions(LiveSetup setup)
    : setup_(std::move(setup)),
      turns_({.places = std::max(1, setup_.at_once), .for_quick = setup_.at_once > 1 ? 1 : 0}) {}

LiveSessions::~LiveSessions() { close(); }

void LiveSessions::take_out(const std::function<bool(const LiveSession&)>& which, const std::string& why,
                            std::vector<std::shared_ptr<LiveSession>>& gone) {
  for (auto at = sessions_.begin(); at != sessions_.end();) {
    if (!which(*at->second)) {
      ++at;
      continue;
    }
    at->second->end(why);
    gone.push_back(std::move(at->second));
    at = sessions_.erase(at);
  }
}

std::shared_ptr<LiveSession> LiveSessions::begin(std::size_t owner, const std::string& tab,
                                                 const RunRequest& request) {
  std::vector<std::shared_ptr<LiveSession>> gone;  // destroyed without the lock
  const std::lock_guard lock(mutex_);
  if (closed_) refuse_state("the server is being stopped");
  take_out([](const LiveSession& session) { return session.over(); }, "", gone);
  take_out([&](const LiveSession& session) { return session.owner == owner && session.tab == tab; },
           "another script took its place", gone);
  // The longest idle session makes room.
  const auto make_room = [&](std::size_t most, const std::function<bool(const LiveSession&)>& among) {
    std::vector<LiveSession*> there;
    for (const auto& [id, session] : sessions_)
      if (among(*session)) there.push_back(session.get());
    if (there.size() < most) return;
    const auto longest = std::ranges::min_element(there, {}, [](const LiveSession* session) {
      return session->busy() ? LiveSession::Clock::time_point::max() : session->last_used();
    });
    if ((*longest)->busy()) refuse_state("too many scripts follow their knobs", "try again");
    take_out([&](const LiveSession& session) { return &session == *longest; }, "it made room for another one",
             gone);
  };
  make_room(setup_.most_of_one, [&](const LiveSession& session) { return session.owner == owner; });
  make_room(setup_.most, [](const LiveSession&) { return true; });
  const std::string id = std::to_string(++last_id_);
  const auto session = std::make_shared<LiveSession>(id, owner, tab, request, setup_);
  sessions_.emplace(id, session);
  return session;
}

std::shared_ptr<LiveSession> LiveSessions::find(std::size_t owner, const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(id);
  return found == sessions_.end() || found->second->owner != owner || found->second->over() ? nullptr
                                                                                            : found->second;
}

std::int64_t LiveSessions::move(LiveSession& session, const GivenKnobs& knobs, const std::string& view,
                                const std::string& map) {
  std::shared_ptr<void> share;
  if (!session.busy()) {
    share = turns_.take(session.owner, turn_patience);
    if (share == nullptr) refuse_state("the server is busy with the knobs of others", "try again");
  }
  return session.move(knobs, view, map, std::move(share));
}

void LiveSessions::end(std::size_t owner, const std::string& id) {
  std::vector<std::shared_ptr<LiveSession>> gone;
  const std::lock_guard lock(mutex_);
  take_out([&](const LiveSession& session) { return session.owner == owner && session.id == id; },
           "it was ended", gone);
}

void LiveSessions::close() {
  std::vector<std::shared_ptr<LiveSession>> gone;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    take_out([](const LiveSession&) { return true; }, "the server is being stopped", gone);
  }
}

}  // namespace asperity::web
