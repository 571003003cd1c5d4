// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/scripts/runner/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace asperity::scripts {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void become(const Start& start, const std::array<int, 2>& out, const std::array<int, 2>& err) {
  std::vector<char*> arguments;
  for (const std::string& argument : start.command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing < 0 || ::chdir(start.folder.c_str()) != 0 || ::dup2(nothing, 0) < 0 || ::dup2(out[1], 1) < 0 ||
      ::dup2(err[1], 2) < 0)
    ::_exit(126);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

bool take(int file, std::string& text) {
  std::array<char, 4096> block;
  const ssize_t count = ::read(file, block.data(), block.size());
  if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
  return count > 0;
}

std::size_t columns_of(const std::string& row) {
  std::size_t columns = 1;
  bool quoted = false;
  for (const char c : row) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) ++columns;
  }
  return columns;
}

void check_table(const fs::path& table, std::vector<std::string>& faults) {
  const std::string text = content_of(table);
  if (!text.empty() && text.back() != '\n')
    faults.push_back(table.filename().string() + " ends in the middle of a row");
  std::istringstream rows(text);
  std::size_t columns = 0;
  for (std::string row; std::getline(rows, row);) {
    if (row.empty() || row[0] == '#') continue;
    if (columns == 0) columns = columns_of(row);
    if (columns_of(row) != columns) faults.push_back(table.filename().string() + " has a broken row: " + row);
  }
}

}  // namespace

Outcome run_process(const Start& start) {
  std::array<int, 2> out{}, err{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(err.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) become(start, out, err);
  ::close(out[1]);
  ::close(err[1]);

  Outcome outcome;
  const auto end = std::chrono::steady_clock::now() + start.patience;
  bool interrupted = start.interrupt_at.empty(), out_open = true, err_open = true;
  while (out_open || err_open) {
    std::array<pollfd, 2> waits{{{out_open ? out[0] : -1, POLLIN, 0}, {err_open ? err[0] : -1, POLLIN, 0}}};
    ::poll(waits.data(), waits.size(), 200);
    if (waits[0].revents != 0) out_open = take(out[0], outcome.output);
    if (waits[1].revents != 0) err_open = take(err[0], outcome.error);
    if (!interrupted && outcome.output.find(start.interrupt_at) != std::string::npos) {
      ::kill(child, SIGINT);
      interrupted = true;
    }
    if (!outcome.late && std::chrono::steady_clock::now() > end) {
      outcome.late = true;
      ::kill(child, SIGKILL);
    }
  }
  ::close(out[0]);
  ::close(err[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  return outcome;
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "asperity-script-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder for the test");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> faults_of_run(const fs::path& run) {
  std::vector<std::string> faults;
  for (const char* name : {"script.lua", "manifest.json", "journal.jsonl"})
    if (!fs::is_regular_file(run / name)) faults.push_back(std::string(name) + " is missing");
  if (!faults.empty()) return faults;
  if (!nlohmann::json::accept(content_of(run / "manifest.json")))
    faults.push_back("manifest.json is not JSON");
  const std::string journal = content_of(run / "journal.jsonl");
  if (journal.empty() || journal.back() != '\n')
    faults.push_back("journal.jsonl ends in the middle of a line");
  std::istringstream lines(journal);
  for (std::string line; std::getline(lines, line);)
    if (!nlohmann::json::accept(line)) faults.push_back("a line of journal.jsonl is not JSON: " + line);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(run)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".csv") check_table(entry.path(), faults);
    if (name.find(".tmp") != std::string::npos || name.find(".part") != std::string::npos ||
        (name[0] == '.' && name != ".lock"))  // the free lock remains
      faults.push_back(name + " was left behind");
  }
  return faults;
}

}  // namespace asperity::scripts
