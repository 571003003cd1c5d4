// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace asperity::scripts {

struct Outcome {
  int status = -1;    // undefined after a signal
  int signal = 0;     // 0 after exit
  bool late = false;  // killed after `patience`
  std::string output, error;
};

struct Start {
  std::vector<std::string> command;     // with arguments
  std::filesystem::path folder;         // working folder
  std::string interrupt_at;             // SIGINT once stdout contains this; empty: never
  std::chrono::seconds patience{1200};  // before a kill
};

Outcome run_process(const Start& start);

class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string content_of(const std::filesystem::path& path);

// Faults: manifest.json or a line of journal.jsonl is no JSON, CSV rows differ in length or lack an end,
// temporary files remain.
std::vector<std::string> faults_of_run(const std::filesystem::path& run);

}  // namespace asperity::scripts
