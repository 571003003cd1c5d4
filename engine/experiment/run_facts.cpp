// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/experiment/run_facts.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <string_view>
#include <thread>

#include "engine/core/digest.hpp"
#include "engine/experiment/aside_file.hpp"

namespace asperity {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text.data(), length};
}

namespace {

Json facts_of_this_machine() {
  Json facts = Json::object();
  std::ifstream processors("/proc/cpuinfo");
  for (std::string line; std::getline(processors, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) facts.set("processor", line.substr(colon + 2));
    break;
  }
  facts.set("processors", std::thread::hardware_concurrency());
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0) facts.set("memory", static_cast<std::int64_t>(pages) * page);
  utsname system{};
  if (::uname(&system) == 0)
    facts.set("system", std::string(system.sysname) + " " + system.release + " " + system.machine);
  return facts;
}

}  // namespace

Json machine_facts() {
  static const Json facts = facts_of_this_machine();
  return facts;
}

std::string file_digest(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_file_error("read", path, errno);
  Digester digester;
  digester.add("file");
  std::string piece(std::size_t{1} << 20, '\0');
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    const auto taken = static_cast<std::size_t>(file.gcount());
    if (taken > 0) digester.add(std::string_view(piece).substr(0, taken));
  }
  if (file.bad()) throw_file_error("read", path, EIO);
  return digester.hex();
}

}  // namespace asperity
