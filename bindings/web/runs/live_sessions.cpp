// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/live_sessions.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

#include "bindings/web/confined/disk_bound.hpp"
#include "bindings/web/sandbox/frames.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::web {

namespace {

constexpr std::size_t longest_answer = std::size_t{8} << 20;
constexpr std::int64_t moves_of_a_session = 20;  // least processor time of a session, in moves
constexpr auto turn_patience = std::chrono::seconds(8);

ConfinedRequest live_request(const RunRequest& asked, const LiveSetup& setup) {
  const RunLimits& limits = setup.limits;
  ConfinedRequest request{.work = Work::live, .confinement = {}};
  request.confinement.memory_bytes = limits.memory_bytes;
  request.confinement.file_bytes = limits.directory_bytes;
  request.confinement.processor_seconds =
      moves_of_a_session * static_cast<std::int64_t>(limits.seconds + 1) * std::max(1, limits.threads);
  request.script = asked.script;
  request.name = "script.lua";
  request.seed = asked.seed;
  request.seconds = limits.seconds;
  request.threads = limits.threads;
  request.barriers = setup.barriers;
  return request;
}

std::filesystem::path live_folder(const std::filesystem::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0) throw_file_error("make the folder", folder, errno);
  return folder;
}

// Discards output, except for the last lines, which explain a crash.
void drain(Descriptor& from, std::string* tail) {
  char piece[16384];
  for (int most = 16; from.get() >= 0 && most > 0; --most) {
    const ssize_t got = ::read(from.get(), piece, sizeof piece);
    if (got == 0) from.reset();
    if (got <= 0) return;
    if (tail == nullptr) continue;
    tail->append(piece, static_cast<std::size_t>(got));
    if (tail->size() > 2000) tail->erase(0, tail->size() - 2000);
  }
}

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
      request_(live_request(request, setup)),
      folder_(live_folder(setup.folder / ("live-" + id))),
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
  const std::uint64_t one = 1;
  (void)!::write(wake_.get(), &one, sizeof one);
}

bool LiveSession::busy() const {
  const std::lock_guard lock(mutex_);
  return share_ != nullptr;
}

LiveSession::Clock::time_point LiveSession::last_used() const {
  const std::lock_guard lock(mutex_);
  return used_;
}

std::int64_t LiveSession::move(const GivenKnobs& knobs, const std::string& view,
                               std::shared_ptr<void> share) {
  Json given = Json::object();
  for (const auto& [name, text] : knobs) given.set(name, text);
  const std::lock_guard lock(mutex_);
  if (share != nullptr) share_ = std::move(share);
  used_ = Clock::now();
  question_ = Json::object({{"move", ++moves_}, {"knobs", std::move(given)}, {"view", view}}).text();
  const std::uint64_t one = 1;
  (void)!::write(wake_.get(), &one, sizeof one);
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

void LiveSession::work() {
  try {
    follow();
  } catch (const std::exception& error) {
    finish(error.what());
  }
}

void LiveSession::follow() {
  // In this thread: the process dies with it.
  ConfinedProcess process(request_, folder_.string());
  const int socket = process.drawing.get();
  // A hostile process that reads nothing must not block this thread.
  const timeval most{1, 0};
  ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &most, sizeof most);
  std::string last_words, why;
  Clock::time_point look_at{};
  while (why.empty()) {
    std::array<pollfd, 4> watched{{{socket, POLLIN, 0},
                                   {wake_.get(), POLLIN, 0},
                                   {process.output.get(), POLLIN, 0},
                                   {process.error.get(), POLLIN, 0}}};
    ::poll(watched.data(), watched.size(), 1000);
    if (watched[1].revents != 0) {
      std::uint64_t count = 0;
      (void)!::read(wake_.get(), &count, sizeof count);
      ask(socket);
    }
    const bool answers = watched[0].revents == 0 || take_answers(socket);
    drain(process.output, nullptr);
    drain(process.error, &last_words);
    drain(process.events, nullptr);
    const Clock::time_point now = Clock::now();
    if (!answers || process.ended())
      why = last_words.empty() ? "the script's process ended" : "the script's process ended: " + last_words;
    if (now - last_used() > setup_.idle) why = "no knob was moved for a while";
    if (now >= look_at) {
      const DiskUse use = disk_use(folder_, setup_.limits.files);
      look_at = next_look(now);
      if (use.files > setup_.limits.files || use.bytes > setup_.limits.directory_bytes)
        why = "its files take more of the disk than they may";
    }
    const std::lock_guard lock(mutex_);
    if (!why_.empty()) why = why_;
  }
  process.send(SIGKILL);
  while (!process.ended()) ::poll(nullptr, 0, 1);
  take_answers(socket);
  finish(why);
}

void LiveSession::ask(int socket) {
  std::string question;
  {
    const std::lock_guard lock(mutex_);
    question = std::exchange(question_, {});
  }
  const std::string_view texts[] = {question};
  if (!question.empty() && !send_frame(socket, texts)) end("the script's process took no question");
}

// False if the process has ended or its answer is invalid. Never blocks.
bool LiveSession::take_answers(int socket) {
  std::string piece(std::size_t{1} << 18, '\0');
  bool there = true;  // answers before the end still count
  for (int most = 16; there && most > 0; --most) {
    const ssize_t got = ::recv(socket, piece.data(), piece.size(), MSG_DONTWAIT);
    there = got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
    if (got <= 0) break;
    arrived_.append(piece, 0, static_cast<std::size_t>(got));
  }
  try {
    while (const auto texts = take_frame(arrived_, longest_answer)) take(*texts);
    return there;
  } catch (const Error&) {
    return false;
  }
}

// Throws Error{bad_file}.
void LiveSession::take(const std::vector<std::string>& texts) {
  const Json json = Json::parse(texts.empty() ? std::string() : texts.front(), "an answer");
  const Json *number = json.find("move"), *part = json.find("part");
  if (number == nullptr || part == nullptr) throw Error(ErrorCode::bad_file, "an answer says not of what");
  const double told = number->number();
  const bool last = part->string() != "coarse";
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
    : setup_(std::move(setup)), turns_(1, std::max(1, setup_.at_once), setup_.at_once > 1 ? 1 : 0) {}

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
  if (closed_) throw Error(ErrorCode::bad_state, "the server is being stopped");
  take_out([](const LiveSession& session) { return session.over(); }, "", gone);
  take_out([&](const LiveSession& session) { return session.owner == owner && session.tab == tab; },
           "another script took its place", gone);
  // The session with the longest idle time makes room.
  const auto make_room = [&](std::size_t most, const std::function<bool(const LiveSession&)>& among) {
    std::vector<LiveSession*> there;
    for (const auto& [id, session] : sessions_)
      if (among(*session)) there.push_back(session.get());
    if (there.size() < most) return;
    const auto longest = std::ranges::min_element(there, {}, [](const LiveSession* session) {
      return session->busy() ? LiveSession::Clock::time_point::max() : session->last_used();
    });
    if ((*longest)->busy())
      throw Error(ErrorCode::bad_state, "as many scripts follow their knobs as may", "try again");
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

std::int64_t LiveSessions::move(LiveSession& session, const GivenKnobs& knobs, const std::string& view) {
  std::shared_ptr<void> share;
  if (!session.busy()) {
    share = turns_.take(session.owner, turn_patience);
    if (share == nullptr)
      throw Error(ErrorCode::bad_state, "the knobs of others are being moved, and no turn came", "try again");
  }
  return session.move(knobs, view, std::move(share));
}

void LiveSessions::end(std::size_t owner, const std::string& id) {
  std::vector<std::shared_ptr<LiveSession>> gone;
  const std::lock_guard lock(mutex_);
  take_out([&](const LiveSession& session) { return session.owner == owner && session.id == id; },
           "it was ended", gone);
}

std::size_t LiveSessions::count() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(
      std::ranges::count_if(sessions_, [](const auto& entry) { return !entry.second->over(); }));
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
