// SPDX-License-Identifier: GPL-3.0-or-later
// Another program run to its end, with what it wrote and how it ended, for tests of the command line.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace asperity::scripts {

struct Outcome {
  int status = -1;    // of exit; meaningless if it died of a signal
  int signal = 0;     // that ended it, 0 if it exited
  bool late = false;  // it was killed because it did not end in time
  std::string output, error;
};

struct Start {
  std::vector<std::string> command;     // program and arguments
  std::filesystem::path folder;         // to run in
  std::string interrupt_at;             // SIGINT is sent once standard output holds this; empty: never
  std::chrono::seconds patience{1200};  // then it is killed
};

Outcome run_process(const Start& start);

// A fresh folder, gone with the object.
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

// What is wrong with the records of a run, a sentence each: manifest.json and every line of
// journal.jsonl must be JSON, every row of every CSV as long as its header and ended, and nothing
// half-written may lie about.
std::vector<std::string> faults_of_run(const std::filesystem::path& run);

}  // namespace asperity::scripts
