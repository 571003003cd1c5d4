// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/runs/answers.hpp"

#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

HttpResponse json_answer(const Json& json, int status) {
  return {.status = status,
          .headers = {{"Cache-Control", "no-store"}},
          .type = "application/json",
          .body = json.text() + "\n"};
}

HttpResponse problem_answer(int status, const std::string& message, const std::string& hint) {
  Json problem = Json::object({{"message", message}});
  if (!hint.empty()) problem.set("hint", hint);
  return json_answer(Json::object({{"error", problem}}), status);
}

Json body_of(const HttpRequest& request) {
  Json body = Json::parse(request.body, "the body of the request");
  if (!body.is_object()) throw Error(ErrorCode::bad_value, "the body of the request is no object");
  return body;
}

std::string text_member(const Json& body, const std::string& key, std::size_t longest) {
  const Json* found = body.find(key);
  if (found == nullptr) throw Error(ErrorCode::bad_value, "the request has no " + asperity::quoted(key));
  if (!found->is_string()) throw Error(ErrorCode::bad_value, asperity::quoted(key) + " is no text");
  const std::string& text = found->string();
  if (text.size() > longest)
    throw Error(ErrorCode::bad_value,
                asperity::quoted(key) + " has " + std::to_string(text.size()) + " bytes",
                "give at most " + std::to_string(longest));
  return text;
}

std::int64_t whole_member(const Json& body, const std::string& key, std::int64_t otherwise) {
  const Json* found = body.find(key);
  if (found == nullptr || found->is_null()) return otherwise;
  const double number = found->number();
  if (!(number >= 0 && number <= 1e15) || number != std::floor(number))
    throw Error(ErrorCode::bad_value, asperity::quoted(key) + " is " + format_short(number),
                "give a whole number from 0 on");
  return static_cast<std::int64_t>(number);
}

GivenKnobs knobs_member(const Json& body, const std::string& key) {
  constexpr std::size_t most = 100, longest = 100;
  const Json* found = body.find(key);
  if (found == nullptr || found->is_null()) return {};
  if (!found->is_object()) throw Error(ErrorCode::bad_value, asperity::quoted(key) + " is no object");
  const Json::Members& members = found->members();
  if (members.size() > most)
    throw Error(ErrorCode::bad_value,
                asperity::quoted(key) + " has " + std::to_string(members.size()) + " members",
                "give at most " + std::to_string(most));
  GivenKnobs knobs;
  for (const auto& [name, value] : members) {
    if (!value.is_string())
      throw Error(ErrorCode::bad_value, "the value of " + asperity::quoted(name) + " is no text",
                  "give a number with its unit in quotes, such as \"50 MPa\"");
    if (value.string().size() > longest)
      throw Error(ErrorCode::bad_value, "the value of " + asperity::quoted(name) + " is too long");
    give_knob(knobs, name, value.string());
  }
  return knobs;
}

bool flag_member(const Json& body, const std::string& key) {
  const Json* found = body.find(key);
  return found != nullptr && !found->is_null() && found->boolean();
}

}  // namespace asperity::web
