// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/command_request.hpp"

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

namespace {

Json text_json(const std::string& bytes) { return characters_of(bytes); }

Json optional_text(const std::optional<std::string>& bytes) { return bytes ? text_json(*bytes) : Json(); }

Json texts_json(const std::vector<std::string>& texts) {
  Json::List list;
  for (const std::string& text : texts) list.push_back(text_json(text));
  return list;
}

// As digits: JSON doubles cannot hold every seed.
template <class Number>
Json optional_digits(const std::optional<Number>& number) {
  return number ? Json(std::to_string(*number)) : Json();
}

const Json& command_member(const Json& json, const char* name) {
  const Json* const found = json.is_object() ? json.find(name) : nullptr;
  if (found == nullptr) throw Error(ErrorCode::bad_file, "the command has no " + asperity::quoted(name));
  return *found;
}

std::string text_in(const Json& json, const char* name) {
  return bytes_of(command_member(json, name).string());
}

std::optional<std::string> optional_text_in(const Json& json, const char* name) {
  if (command_member(json, name).is_null()) return {};
  return text_in(json, name);
}

std::vector<std::string> texts_in(const Json& json, const char* name) {
  std::vector<std::string> texts;
  for (const Json& text : command_member(json, name).list()) texts.push_back(bytes_of(text.string()));
  return texts;
}

std::optional<std::int64_t> optional_whole_in(const Json& json, const char* name) {
  if (command_member(json, name).is_null()) return {};
  return std::strtoll(command_member(json, name).string().c_str(), nullptr, 10);
}

int small_in(const Json& json, const char* name) {
  return static_cast<int>(command_member(json, name).number());
}

}  // namespace

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
      throw Error(ErrorCode::bad_file, "a text of the command holds a character that is no byte");
    bytes += static_cast<char>((lead & 0x03) << 6 | (static_cast<unsigned char>(characters[k]) & 0x3F));
  }
  return bytes;
}

Json knobs_json(const GivenKnobs& knobs) {
  Json::List list;
  for (const auto& [name, text] : knobs) list.push_back(texts_json({name, text}));
  return list;
}

GivenKnobs knobs_in(const Json& json, const char* name) {
  GivenKnobs knobs;
  for (const Json& knob : command_member(json, name).list())
    knobs.emplace(bytes_of(knob.list().at(0).string()), bytes_of(knob.list().at(1).string()));
  return knobs;
}

Json command_json(const cli::RunCommand& run, const cli::ReplayCommand* replay) {
  Json json = Json::object({{"script", text_json(run.script)},
                            {"out", optional_text(run.out)},
                            {"threads", run.threads},
                            {"seed", std::to_string(run.seed)},
                            {"seed_given", run.seed_given},
                            {"limit_memory", optional_digits(run.limit_memory)},
                            {"limit_time", run.limit_time ? Json(*run.limit_time) : Json()},
                            {"arguments", texts_json(run.arguments)},
                            {"knobs", knobs_json(run.knobs)},
                            {"text", optional_text(run.text)},
                            {"resume", optional_text(run.resume)},
                            {"reuse", texts_json(run.reuse)},
                            {"store", optional_text(run.store)},
                            {"store_limit", optional_digits(run.store_limit)},
                            {"limit_disk", optional_digits(run.limit_disk)},
                            {"shard", run.shard ? run.shard->index : 0},
                            {"shards", run.shard ? run.shard->count : 0},
                            {"barriers", run.barriers},
                            {"terminal", run.terminal}});
  if (replay != nullptr)
    json.set("replay", Json::object({{"recorded", text_json(replay->recorded)},
                                     {"from", optional_digits(replay->from)},
                                     {"settings", texts_json(replay->settings)}}));
  return json;
}

CarriedCommand command_of(const Json& json) {
  CarriedCommand carried;
  cli::RunCommand& run = carried.run;
  run.script = text_in(json, "script");
  run.out = optional_text_in(json, "out");
  run.threads = small_in(json, "threads");
  run.seed = std::strtoull(command_member(json, "seed").string().c_str(), nullptr, 10);
  run.seed_given = command_member(json, "seed_given").boolean();
  run.limit_memory = optional_whole_in(json, "limit_memory");
  if (const Json& limit = command_member(json, "limit_time"); !limit.is_null())
    run.limit_time = limit.number();
  run.arguments = texts_in(json, "arguments");
  run.knobs = knobs_in(json, "knobs");
  run.text = optional_text_in(json, "text");
  run.resume = optional_text_in(json, "resume");
  run.reuse = texts_in(json, "reuse");
  run.store = optional_text_in(json, "store");
  run.store_limit = optional_whole_in(json, "store_limit");
  run.limit_disk = optional_whole_in(json, "limit_disk");
  if (const int count = small_in(json, "shards"); count > 0)
    run.shard = Shard{small_in(json, "shard"), count};
  run.barriers = command_member(json, "barriers");
  run.terminal = command_member(json, "terminal").boolean();
  if (const Json* const replay = json.find("replay")) {
    carried.replay.emplace();
    carried.replay->recorded = text_in(*replay, "recorded");
    carried.replay->from = optional_whole_in(*replay, "from");
    carried.replay->settings = texts_in(*replay, "settings");
    carried.replay->run = run;
  }
  return carried;
}

}  // namespace asperity::web
