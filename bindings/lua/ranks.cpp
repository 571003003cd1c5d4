// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ranks.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "engine/core/byte_string.hpp"
#include "engine/core/monitor.hpp"

namespace asperity::lua {

namespace {

std::string result_bytes(const std::string& key, const ResultFacts& facts, const KeptFields& fields) {
  ByteWriter out;
  out.text(key);
  out.number(static_cast<std::uint64_t>(facts.numbers.size()));
  for (const auto& [name, value] : facts.numbers) {
    out.text(name);
    out.number(value);
  }
  out.number(static_cast<std::uint64_t>(facts.texts.size()));
  for (const auto& [name, text] : facts.texts) {
    out.text(name);
    out.text(text);
  }
  out.number(facts.cost.seconds);
  out.number(facts.cost.transforms);
  out.number(facts.cost.bytes);
  out.number(static_cast<std::uint64_t>(fields.size()));
  for (const auto& [name, field] : fields) {
    out.text(name);
    out.number(field->nx());
    out.number(field->ny());
    out.numbers(field->values());
  }
  return out.take();
}

FoundResult result_from(ByteReader& in) {
  FoundResult found;
  for (std::size_t left = in.count(); left > 0; --left) {
    std::string name = in.text();
    found.numbers.emplace_back(std::move(name), in.number<double>());
  }
  for (std::size_t left = in.count(); left > 0; --left) {
    std::string name = in.text();
    found.texts.emplace_back(std::move(name), in.text());
  }
  found.cost.seconds = in.number<double>();
  found.cost.transforms = in.number<decltype(found.cost.transforms)>();
  found.cost.bytes = in.number<decltype(found.cost.bytes)>();
  for (std::size_t left = in.count(); left > 0; --left) {
    std::string name = in.text();
    const int nx = in.number<int>(), ny = in.number<int>();
    const Array<double> values = in.numbers([](std::size_t length) { return Array<double>(length); });
    Field field(nx, ny);
    if (field.size() != values.size()) ByteReader::damaged();
    std::ranges::copy(values, field.values().begin());
    found.fields.emplace_back(std::move(name), std::move(field));
  }
  return found;
}

}  // namespace

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

std::optional<FoundResult> RankStore::find(const std::string& key) {
  if (ranks_.leads()) {
    if (ranks_.own_store == nullptr) return {};
    std::optional<FoundResult> found = ranks_.own_store->find(key);
    if (found) {
      KeptFields fields;
      for (const auto& [name, field] : found->fields) fields.emplace_back(name, &field);
      ranks_.send_to_others(Ranks::Kind::kept, result_bytes(key, *found, fields));
    }
    return found;
  }
  for (;;) {
    std::optional<Ranks::Message> message = ranks_.receive();
    if (!message) {
      stop_flag().check();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    if (message->kind == Ranks::Kind::kept) {
      ByteReader in(message->bytes);
      if (in.text() == key) return result_from(in);
    }
    // Rank 0 is past this call, or had no result of it.
    ranks_.put_back(*std::move(message));
    return {};
  }
}

void RankStore::keep(const std::string& key, std::string_view call, const ResultFacts& facts,
                     const KeptFields& fields) {
  if (!ranks_.leads()) return;
  if (ranks_.own_store != nullptr) ranks_.own_store->keep(key, call, facts, fields);
  ranks_.send_to_others(Ranks::Kind::kept, result_bytes(key, facts, fields));
}

}  // namespace asperity::lua
