// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run_facts.hpp"

#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <memory>
#include <thread>

#include "engine/core/digest.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/program_identity.hpp"
#include "engine/core/text.hpp"

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

constexpr std::size_t digested_piece = std::size_t{1} << 20;

std::string vector_instructions(const std::string& flags) {
  const std::string all = " " + flags + " ";
  std::vector<std::string> found;
  for (const char* name : {"sse2", "avx", "fma", "avx2", "avx512f"})
    if (all.find(" " + std::string(name) + " ") != std::string::npos) found.emplace_back(name);
  return joined(found, " ");
}

Json facts_of_this_machine() {
  Json facts = Json::object();
  std::ifstream processors("/proc/cpuinfo");
  for (std::string line; std::getline(processors, line) && !line.empty();) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    if (line.starts_with("model name")) facts.set("processor", line.substr(colon + 2));
    if (line.starts_with("flags"))
      facts.set("vector_instructions", vector_instructions(line.substr(colon + 2)));
  }
  facts.set("processors", std::thread::hardware_concurrency());
#if defined(__EMSCRIPTEN__)
  facts.set("pictures", "left to the page");
#endif
  facts.set("memory", memory::of_machine());
  utsname system{};
  if (::uname(&system) == 0)
    facts.set("system", std::string(system.sysname) + " " + system.release + " " + system.machine);
  if (const std::string library = c_library_version(); !library.empty()) facts.set("c_library", library);
  facts.set("c_library_functions", c_library_functions());
  if (const std::string build = build_identity(); !build.empty()) facts.set("build", build);
  return facts;
}

}  // namespace

Json machine_facts() {
  static const Json facts = facts_of_this_machine();
  return facts;
}

Json machine_facts_of_pictures() {
  Json facts = machine_facts();
  const auto ask = [&facts](const char* name, const char* command) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> answer(::popen(command, "r"), ::pclose);
    std::array<char, 256> line{};
    if (answer == nullptr || std::fgets(line.data(), line.size(), answer.get()) == nullptr) return;
    facts.set(name, std::string(line.data(), std::strcspn(line.data(), "\n")));
  };
  ask("gnuplot", "gnuplot --version 2> /dev/null");
  ask("picture_font", "fc-match -f '%{fullname[0]} %{fontversion}' 'DejaVu Sans' 2> /dev/null");
  return facts;
}

std::vector<std::string> differing_machines(const Json& then, const Json& now) {
  std::vector<std::string> lines;
  const auto compare = [&](const char* name, const std::string& what, bool with_values) {
    const Json *before = then.find(name), *after = now.find(name);
    if (before == nullptr || after == nullptr || *before == *after) return;
    lines.push_back("another " + what +
                    (with_values ? ": " + before->string() + ", here " + after->string() : ""));
  };
  compare("processor", "processor", true);
  compare("vector_instructions", "set of vector instructions", true);
  compare("c_library", "C library", true);
  compare("c_library_functions", "rounding of the C library's functions, which it chooses by the processor",
          false);
  compare("gnuplot", "gnuplot", true);
  compare("picture_font", "font in pictures", true);
  compare("build", "build of the program: identity", true);
  return lines;
}

std::string content_digest(std::string_view content) {
  Digester digester;
  digester.add("file");
  for (; !content.empty(); content.remove_prefix(std::min(content.size(), digested_piece)))
    digester.add(content.substr(0, digested_piece));
  return digester.hex();
}

std::string file_digest(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_file_error("read", path, errno);
  Digester digester;
  digester.add("file");
  std::string piece(digested_piece, '\0');
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    const auto taken = static_cast<std::size_t>(file.gcount());
    if (taken > 0) digester.add(std::string_view(piece).substr(0, taken));
  }
  if (file.bad()) throw_file_error("read", path, EIO);
  return digester.hex();
}

}  // namespace asperity
