// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/serve_setup.hpp"

#include <arpa/inet.h>
#include <sys/stat.h>
#include <algorithm>
#include <cerrno>
#include <fstream>
#include <set>

#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/text.hpp"

namespace asperity::web {

namespace {

namespace fs = std::filesystem;

constexpr int most_students = 400;

bool is_v6(const std::string& address) {
  in6_addr parsed{};
  return ::inet_pton(AF_INET6, address.c_str(), &parsed) == 1;
}

void check_address(const std::string& address) {
  in_addr v4{};
  if (::inet_pton(AF_INET, address.c_str(), &v4) != 1 && !is_v6(address))
    throw Error(
        ErrorCode::bad_value, "`--classroom` names " + asperity::quoted(address) + ", which is no address",
        "give the address this machine has in the room, such as 192.168.1.20 (`ip -brief address` shows it)");
  if (address == "0.0.0.0" || address == "::")
    throw Error(ErrorCode::bad_value,
                "`--classroom` names " + asperity::quoted(address) + ", which is every network at once",
                "give the one address this machine has in the room");
}

std::vector<std::string> names_in(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw Error(ErrorCode::bad_file, "there is no file " + asperity::quoted(path) + " that can be read",
                "give the students' names in it, one per line");
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (std::string line; std::getline(file, line);) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t'))
      line.pop_back();
    if (line.empty()) continue;
    if (!seen.insert(line).second)
      throw Error(ErrorCode::bad_file,
                  asperity::quoted(path) + " names " + asperity::quoted(line) + " twice");
    names.push_back(plain_text(line));
  }
  return names;
}

}  // namespace

std::vector<Person> people_of(const ServeCommand& command) {
  std::vector<std::string> names;
  if (command.classroom.empty()) {
    if (command.students > 0 || !command.names.empty())
      throw Error(ErrorCode::bad_value, "students were named and no room",
                  "add --classroom ADDRESS, the address this machine has there");
    return {{"you", new_token()}};
  }
  check_address(command.classroom);
  names.emplace_back("teacher");
  if (!command.names.empty())
    for (std::string& name : names_in(command.names)) names.push_back(std::move(name));
  else
    for (int k = 1; k <= command.students; ++k) names.push_back("student " + std::to_string(k));
  if (names.size() == 1)
    throw Error(ErrorCode::bad_value, "a room was named and no students",
                "add --students 30, or --names FILE, one name a line");
  if (names.size() > most_students + 1)
    throw Error(ErrorCode::bad_value, std::to_string(names.size() - 1) + " students were named",
                "at most " + std::to_string(most_students) + " can be served together");
  std::vector<Person> people;
  for (std::string& name : names) people.push_back({std::move(name), new_token()});
  return people;
}

QueueSetup queue_of(const ServeCommand& command) {
  const bool room = !command.classroom.empty();
  const int processors = thread_count();
  QueueSetup setup;
  setup.shared = room;
  setup.at_once = command.runs > 0 ? command.runs : room ? processors : 2;
  setup.most_waiting_of_one = room ? 20 : 500;
  setup.most_bytes_of_one = (room ? std::int64_t{1} : std::int64_t{8}) << 30;
  RunLimits& limits = setup.limits;
  limits.threads = room ? 1 : processors;
  limits.seconds = command.limit_time.value_or(room ? 60 : 600);
  const std::int64_t share = memory::of_machine() / 2 / setup.at_once, least = std::int64_t{256} << 20;
  limits.memory_bytes = command.limit_memory.value_or(
      std::clamp(share, least, (room ? std::int64_t{1} : std::int64_t{8}) << 30));
  limits.directory_bytes = (room ? std::int64_t{64} : std::int64_t{1024}) << 20;
  return setup;
}

fs::path session_folder(const ServeCommand& command) {
  std::error_code problem;
  if (!command.out.empty()) {
    fs::create_directories(command.out, problem);
    if (problem) throw_file_error("make the folder", command.out, problem.value());
    if (!fs::is_empty(command.out, problem) || problem)
      throw Error(ErrorCode::bad_value,
                  "`--out` names " + asperity::quoted(command.out) + ", which is not empty",
                  "give a new folder");
    if (::chmod(command.out.c_str(), 0700) != 0)
      throw_file_error("keep to yourself the folder", command.out, errno);
    return fs::canonical(command.out);
  }
  fs::create_directories("runs", problem);
  if (problem) throw_file_error("make the folder", "runs", problem.value());
  for (int n = 1;; ++n) {
    const fs::path folder = fs::path("runs") / ("serve-" + std::to_string(n));
    if (::mkdir(folder.c_str(), 0700) == 0) return fs::canonical(folder);
    if (errno != EEXIST) throw_file_error("make the folder", folder, errno);
  }
}

std::string shown_address(const ServeCommand& command) {
  if (command.classroom.empty()) return "127.0.0.1";
  return is_v6(command.classroom) ? "[" + command.classroom + "]" : command.classroom;
}

std::vector<std::string> hosts_of(const ServeCommand& command, int port) {
  std::vector<std::string> names{shown_address(command)};
  if (command.classroom.empty()) names.emplace_back("localhost");
  std::vector<std::string> hosts;
  for (const std::string& name : names) {
    hosts.push_back(name + ":" + std::to_string(port));
    if (port == 80) hosts.push_back(name);
  }
  return hosts;
}

}  // namespace asperity::web
