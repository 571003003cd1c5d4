// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/session.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "engine/core/error.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/run/run_facts.hpp"

namespace asperity::lua {

std::string present_digest(const std::string& file) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(file, problem)) return {};
  try {
    return file_digest(file);
  } catch (const Error&) {
    return {};
  }
}

CaseInput input_of_case(const std::string& file) {
  std::error_code problem;
  CaseInput input{file, 0, present_digest(file)};
  if (!input.digest.empty())
    input.bytes = static_cast<std::int64_t>(std::filesystem::file_size(file, problem));
  return input;
}

const LoadedFile* recorded_copy(const std::shared_ptr<const LoadedFiles>& loaded, const std::string& file) {
  if (loaded == nullptr) return nullptr;
  const auto found = loaded->find(file);
  return found == loaded->end() ? nullptr : &found->second;
}

void note_inputs_of_case(const Session& session, const std::vector<CaseInput>& inputs) {
  for (const CaseInput& input : inputs) {
    if (session.notes != nullptr) session.notes->inputs.push_back(input);
    if (session.notes != nullptr || session.run == nullptr || input.digest.empty()) continue;
    // The case may have run elsewhere or earlier.
    const LoadedFile* copy = input.loaded ? recorded_copy(session.loaded, input.file) : nullptr;
    if (copy != nullptr)
      session.run->note_loaded(input.file, copy->text);
    else if (input.loaded && present_digest(input.file) == input.digest)
      session.run->note_loaded(input.file, text_of_file(input.file));
    else
      session.run->note_input(input.file, input.bytes, input.digest);
  }
}

namespace {
const char session_key = 0;
}

Session& Session::of(lua_State* L) { return *find(L); }

Session* Session::find(lua_State* L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &session_key);
  auto* session = static_cast<Session*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return session;
}

void Session::attach(lua_State* L, Session& session) {
  lua_pushlightuserdata(L, &session);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &session_key);
}

void Session::nudge_collector(lua_State* L, std::size_t bytes) {
  constexpr std::size_t at_least = std::size_t{64} << 20;
  unseen_bytes_ += bytes;
  std::size_t enough = std::max(at_least, static_cast<std::size_t>(memory::held()) / 2);
  if (memory::limit() > 0) enough = std::min(enough, static_cast<std::size_t>(memory::limit()) / 8);
  if (unseen_bytes_ < enough) return;
  unseen_bytes_ = 0;
  lua_gc(L, LUA_GCCOLLECT);
}

}  // namespace asperity::lua
