// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace asperity::scripts {

struct Outcome {
  int status = -1;    // of exit; undefined after a signal
  int signal = 0;     // that ended the process, or 0
  bool late = false;  // killed by the time limit
  std::string output, error;
};

struct Start {
  std::vector<std::string> command;     // program and arguments
  std::filesystem::path folder;         // working folder
  std::string interrupt_at;             // send SIGINT once stdout contains this; empty: never
  std::chrono::seconds patience{1200};  // time limit before a kill
};

Outcome run_process(const Start& start);

// A fresh folder, removed with the object.
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

// Faults in a run's records: manifest.json and all lines of journal.jsonl must be JSON, CSV rows as long as
// their header and terminated; no temporary files.
std::vector<std::string> faults_of_run(const std::filesystem::path& run);

}  // namespace asperity::scripts
