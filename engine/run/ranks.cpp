// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/ranks.hpp"

#include <thread>

#include "engine/core/files/byte_string.hpp"
#include "engine/core/files/result_log.hpp"
#include "engine/core/text.hpp"

namespace asperity {

void Ranks::send(int to, Kind kind, const std::string& bytes) {
  send_bytes(to, std::string(1, static_cast<char>(kind)) + bytes);
}

void Ranks::send_to_others(Kind kind, const std::string& bytes) {
  for (int other = 0; other < size_; ++other)
    if (other != rank_ && !lost(other)) send(other, kind, bytes);
}

std::optional<Ranks::Message> Ranks::receive() {
  if (!put_back_.empty()) {
    Message message = std::move(put_back_.front());
    put_back_.pop_front();
    return message;
  }
  while (auto found = receive_bytes()) {
    if (lost(found->first) || found->second.empty()) continue;
    const auto kind = static_cast<Kind>(found->second[0]);
    return Message{found->first, kind, found->second.substr(1)};
  }
  return {};
}

void Ranks::lose(int other, const std::string& why) {
  if (!lost_.insert(other).second) return;
  losses_.push_back("rank " + std::to_string(other) + " " + why);
}

Ranks::Message Ranks::next() {
  for (;;) {
    if (std::optional<Message> message = receive()) return *std::move(message);
    stop_flag().check();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void Ranks::meet(const std::string& what, int ensembles) {
  ++meetings_;
  if (leads())
    call_together(what, ensembles);
  else
    wait_for_call(what, ensembles);
}

namespace {

[[noreturn]] void throw_apart(const std::string& what, const std::string& why) {
  refuse_state(what + " is done by all ranks together, and " + without_traceback(why));
}

}  // namespace

void Ranks::call_together(const std::string& what, int ensembles) {
  std::set<int> here;
  while (static_cast<int>(here.size() + lost_.size()) < size_ - 1) {
    const Message message = next();
    ByteReader in(message.bytes);
    const std::string name = in.text();
    if (message.kind == Kind::here) {
      if (name == what)
        here.insert(message.from);
      else
        lose(message.from, "reached " + name + " when rank 0 reached " + what +
                               ": the script must do the same in every process");
    } else if (message.kind == Kind::end) {
      lose(message.from, name.empty() ? "ended before rank 0" : "failed: " + name);
    } else if (message.kind == Kind::hello && std::stoll(name) > ensembles) {
      lose(message.from, "reached an ensemble when rank 0 reached " + what +
                             ": the script must do the same in every process");
    }  // else a late message
  }
  const std::string loss = losses_.empty() ? "" : losses_.front();
  send_to_others(Kind::go, ByteWriter().number(meetings_).text(loss).take());
  if (!losses_.empty()) throw_apart(what, losses_.front());
}

void Ranks::wait_for_call(const std::string& what, int ensembles) {
  send(0, Kind::here, ByteWriter().text(what).take());
  for (;;) {
    Message message = next();
    ByteReader in(message.bytes);
    if (message.kind == Kind::end) {
      put_back(std::move(message));
      throw_apart(what, "rank 0 has ended or takes another way");
    }
    if ((message.kind == Kind::cases || message.kind == Kind::rows) && std::stoll(in.text()) > ensembles)
      throw_apart(what, "rank 0 reached an ensemble");
    if (message.kind != Kind::go || in.number<std::uint64_t>() != meetings_) continue;
    if (const std::string why = in.text(); !why.empty()) throw_apart(what, why);
    return;
  }
}

std::optional<FoundResult> RankStore::find(const std::string& key) {
  if (ranks_.leads()) {
    if (ranks_.own_store == nullptr) return {};
    std::optional<FoundResult> found = ranks_.own_store->find(key);
    if (found) ranks_.send_to_others(Ranks::Kind::kept, result_bytes(key, *found, found->kept()));
    return found;
  }
  Ranks::Message message = ranks_.next();
  if (message.kind == Ranks::Kind::kept) {
    ByteReader in(message.bytes);
    if (in.text() == key) return result_from(in);
  }
  ranks_.put_back(std::move(message));
  return {};
}

void RankStore::keep(const std::string& key, std::string_view call, const ResultFacts& facts,
                     const KeptFields& fields) {
  if (!ranks_.leads()) return;
  if (ranks_.own_store != nullptr) ranks_.own_store->keep(key, call, facts, fields);
  ranks_.send_to_others(Ranks::Kind::kept, result_bytes(key, facts, fields));
}

}  // namespace asperity
