// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/confined_request.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdlib>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

namespace {

constexpr std::array<const char*, 6> works{"run", "check", "draw", "probe", "command", "live"};

std::string characters_of(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xC0 | (byte >> 6));
      text += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return text;
}

// Writes members as JSON. The lists of members serve Writer and Reader.
struct Writer {
  Json json = Json::object();

  template <class T>
  void operator()(const char* name, T& value) {
    json.set(name, as_json(value));
  }
  template <class T>
  void optional(const char* name, T& value) {
    (*this)(name, value);
  }

  static Json as_json(const std::string& value) { return characters_of(value); }
  static Json as_json(Work value) { return works.at(static_cast<std::size_t>(value)); }
  template <std::convertible_to<Json> T>
  static Json as_json(T value) {
    return value;
  }
  template <class T>
  static Json as_json(const std::optional<T>& value) {
    return value ? as_json(*value) : Json();
  }
  template <class T>
  static Json as_json(const std::vector<T>& values) {
    Json::List list;
    for (const T& value : values) list.push_back(as_json(value));
    return list;
  }
  static Json as_json(const GivenKnobs& knobs) {
    Json::List list;
    for (const auto& [name, text] : knobs) list.push_back(as_json(std::vector<std::string>{name, text}));
    return list;
  }
  template <class T>
  static Json as_json(T object) {
    Writer writer;
    each_member(writer, object);
    return writer.json;
  }
};

struct Reader {
  const Json& json;

  template <class T>
  void operator()(const char* name, T& value) {
    const Json* const found = json.is_object() ? json.find(name) : nullptr;
    if (found == nullptr) refuse_bad_file("the request has no " + asperity::quoted(name));
    read(*found, value);
  }
  // Keeps the value if the member is missing.
  template <class T>
  void optional(const char* name, T& value) {
    if (const Json* const found = json.find(name)) read(*found, value);
  }

  static void read(const Json& from, Json& value) { value = from; }
  static void read(const Json& from, std::string& value) { value = bytes_of(from.string()); }
  static void read(const Json& from, double& value) { value = from.number(); }
  static void read(const Json& from, bool& value) { value = from.boolean(); }
  static void read(const Json& from, Work& value) {
    const auto known = std::ranges::find(works, from.string());
    if (known == works.end()) refuse_bad_file("the request is to " + asperity::quoted(from.string()));
    value = static_cast<Work>(known - works.begin());
  }
  // From the text: a double cannot hold every integer.
  template <std::integral T>
  static void read(const Json& from, T& value) {
    const std::string digits = from.is_string() ? from.string() : from.text();
    value = static_cast<T>(std::is_unsigned_v<T> ? std::strtoull(digits.c_str(), nullptr, 10)
                                                 : std::strtoll(digits.c_str(), nullptr, 10));
  }
  template <class T>
  static void read(const Json& from, std::optional<T>& value) {
    if (!from.is_null()) read(from, value.emplace());
  }
  template <class T>
  static void read(const Json& from, std::vector<T>& values) {
    for (const Json& item : from.list()) read(item, values.emplace_back());
  }
  static void read(const Json& from, GivenKnobs& knobs) {
    std::vector<std::vector<std::string>> pairs;
    read(from, pairs);
    for (const auto& pair : pairs) knobs.emplace(pair.at(0), pair.at(1));
  }
  template <class T>
  static void read(const Json& from, T& object) {
    Reader reader{from};
    each_member(reader, object);
  }
};

template <class Each>
void each_member(Each& each, Place& place) {
  each("folder", place.folder);
  each("seen", place.seen);
  each("write", place.write);
}

template <class Each>
void each_member(Each& each, Shard& shard) {
  each("index", shard.index);
  each("count", shard.count);
}

template <class Each>
void each_member(Each& each, cli::ReplayCommand& replay) {
  each("recorded", replay.recorded);
  each("from", replay.from);
  each("settings", replay.settings);
}

template <class Each>
void each_member(Each& each, CarriedCommand& carried) {
  cli::RunCommand& run = carried.run;
  each("script", run.script);
  each("out", run.out);
  each("threads", run.threads);
  each("seed", run.seed);
  each("seed_given", run.seed_given);
  each("limit_memory", run.limit_memory);
  each("limit_time", run.limit_time);
  each("arguments", run.arguments);
  each("knobs", run.knobs);
  each("text", run.text);
  each("resume", run.resume);
  each("reuse", run.reuse);
  each("store", run.store);
  each("store_limit", run.store_limit);
  each("limit_disk", run.limit_disk);
  each("shard", run.shard);
  each("barriers", run.barriers);
  each("terminal", run.terminal);
  each("replay", carried.replay);
}

template <class Each>
void each_member(Each& each, ConfinedRequest& request) {
  Confinement& held = request.confinement;
  bool drawing = held.as == Confined::drawing;
  each("work", request.work);
  each("drawing", drawing);
  held.as = drawing ? Confined::drawing : Confined::script;
  each("memory_bytes", held.memory_bytes);
  each("file_bytes", held.file_bytes);
  each("processor_seconds", held.processor_seconds);
  each.optional("parent", held.parent);
  each.optional("places", held.places);
  each.optional("work_folder", held.work);
  each("script", request.script);
  each("seed", request.seed);
  each("seconds", request.seconds);
  each("threads", request.threads);
  each("views", request.views);
  each.optional("knobs", request.knobs);
  each("barriers", request.barriers);
  each.optional("command", request.command);
  each.optional("lock", request.lock);
}

}  // namespace

std::string bytes_of(std::string_view characters) {
  std::string bytes;
  bytes.reserve(characters.size());
  for (std::size_t k = 0; k < characters.size(); ++k) {
    const auto lead = static_cast<unsigned char>(characters[k]);
    if (lead < 0x80) {
      bytes += characters[k];
      continue;
    }
    if ((lead != 0xC2 && lead != 0xC3) || ++k == characters.size())
      refuse_bad_file("a text of the command holds a character that is no byte");
    bytes += static_cast<char>((lead & 0x03) << 6 | (static_cast<unsigned char>(characters[k]) & 0x3F));
  }
  return bytes;
}

cli::RunCommand page_command(const ConfinedRequest& request, cli::RunObserver& observer) {
  cli::RunCommand command;
  command.script = page_script;
  command.text = request.script;
  command.out = ".";
  command.threads = request.threads;
  command.seed = static_cast<std::uint64_t>(request.seed);
  command.knobs = request.knobs;
  command.limit_memory = request.confinement.memory_bytes;
  command.limit_time = request.seconds;
  command.limit_disk = request.confinement.file_bytes;
  command.store_limit = 0;
  command.observer = &observer;
  return command;
}

Json to_json(const ConfinedRequest& request) {
  ConfinedRequest sent = request;
  sent.confinement.parent = ::getpid();
  if (sent.lock >= 0) sent.lock = lock_descriptor;
  return Writer::as_json(std::move(sent));
}

ConfinedRequest confined_request(const Json& json) {
  ConfinedRequest request;
  Reader::read(json, request);
  request.confinement.threads = request.threads;
  return request;
}

}  // namespace asperity::web
