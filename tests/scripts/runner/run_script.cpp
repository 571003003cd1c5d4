// SPDX-License-Identifier: GPL-3.0-or-later
// run_script PROGRAM SCRIPT: checks a run against the lines at the head of the script:
//
//   --! command: check              instead of run; or accuracy, explain
//   --! flags: --limit-time 1s      options of the program (space between them)
//   --! args: a b                   arguments of the script
//   --! exit: 1                     the exit status; 0 if not said
//   --! error: TEXT                 standard error holds this (any number of lines)
//   --! output: TEXT                standard output holds this
//   --! not error: TEXT             standard error does not hold this
//   --! not output: TEXT
//   --! file: NAME: TEXT            a file of the run directory holds this
//   --! no file: NAME               there is no such file
//   --! stop at: TEXT               Ctrl-C once standard output holds this
//   --! again: --threads 2          a further run with these options must write the same output
//
// No run may die of a signal, report an internal error, or leave unreadable records.
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/scripts/runner/process.hpp"

namespace {

using namespace asperity::scripts;

struct Directive {
  std::string key, text;
};

std::vector<Directive> directives_of(const std::string& script) {
  std::vector<Directive> found;
  std::ifstream file(script);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("--! ", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    found.push_back({line.substr(4, colon - 4), line.substr(colon + 2)});
  }
  return found;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

class ScriptCase {
 public:
  ScriptCase(std::string program, std::string script)
      : program_(std::move(program)), script_(std::move(script)) {
    for (const Directive& d : directives_of(script_)) {
      if (d.key == "command")
        command_ = d.text;
      else if (d.key == "flags")
        flags_ = words(d.text);
      else if (d.key == "args")
        arguments_ = words(d.text);
      else if (d.key == "exit")
        exit_ = std::stoi(d.text);
      else if (d.key == "stop at")
        stop_at_ = d.text;
      else if (d.key == "again")
        again_.push_back(words(d.text));
      else
        checks_.push_back(d);
    }
  }

  bool holds() {
    const TemporaryFolder folder;
    const Outcome outcome = run(flags_, folder.path(), "run");
    look(outcome, folder.path() / "run");
    for (std::size_t k = 0; k < again_.size(); ++k) {
      const Outcome other = run(again_[k], folder.path(), "again-" + std::to_string(k));
      if (other.output != outcome.output)
        fail("a second run wrote something else:\n" + other.output + "instead of\n" + outcome.output);
      if (other.status != outcome.status) fail("a second run ended with " + std::to_string(other.status));
    }
    if (failed_)
      std::printf("--- standard output\n%s--- standard error\n%s", outcome.output.c_str(),
                  outcome.error.c_str());
    return !failed_;
  }

 private:
  Outcome run(const std::vector<std::string>& flags, const std::filesystem::path& folder,
              const std::string& name) {
    Start start;
    start.command = {program_, command_, script_};
    start.command.insert(start.command.end(), flags.begin(), flags.end());
    if (keeps_directory()) start.command.insert(start.command.end(), {"--out", (folder / name).string()});
    if (!arguments_.empty()) start.command.emplace_back("--");
    start.command.insert(start.command.end(), arguments_.begin(), arguments_.end());
    start.folder = folder;
    start.interrupt_at = stop_at_;
    return run_process(start);
  }

  void look(const Outcome& outcome, const std::filesystem::path& run) {
    if (outcome.late) fail("it did not come to an end");
    if (outcome.signal != 0) fail("it died of signal " + std::to_string(outcome.signal));
    if (outcome.status != exit_)
      fail("it ended with " + std::to_string(outcome.status) + ", not with " + std::to_string(exit_));
    for (const char* never : {"internal error", "Sanitizer", "terminate called", "runtime error: "})
      if (outcome.error.find(never) != std::string::npos) fail(std::string("standard error holds: ") + never);
    for (const Directive& check : checks_) look(check, outcome, run);
    if (keeps_directory())
      for (const std::string& fault : faults_of_run(run)) fail(fault);
    else if (std::filesystem::directory_iterator(run.parent_path()) != std::filesystem::directory_iterator())
      fail("a check left files behind");
  }

  void look(const Directive& check, const Outcome& outcome, const std::filesystem::path& run) {
    const auto expect = [&](const std::string& text, const std::string& part, bool wanted,
                            const char* place) {
      if ((text.find(part) != std::string::npos) != wanted)
        fail(std::string(place) + (wanted ? " does not hold: " : " holds: ") + part);
    };
    if (check.key == "error") return expect(outcome.error, check.text, true, "standard error");
    if (check.key == "output") return expect(outcome.output, check.text, true, "standard output");
    if (check.key == "not error") return expect(outcome.error, check.text, false, "standard error");
    if (check.key == "not output") return expect(outcome.output, check.text, false, "standard output");
    if (check.key == "no file") {
      if (std::filesystem::exists(run / check.text)) fail("there is a file " + check.text);
      return;
    }
    if (check.key == "file") {
      const std::size_t colon = check.text.find(": ");
      const std::string name = check.text.substr(0, colon);
      return expect(content_of(run / name), check.text.substr(colon + 2), true, name.c_str());
    }
    fail("the script's head has an unknown word: " + check.key);
  }

  bool keeps_directory() const { return command_ != "check" && command_ != "explain"; }

  void fail(const std::string& sentence) {
    std::printf("%s: %s\n", script_.c_str(), sentence.c_str());
    failed_ = true;
  }

  std::string program_, script_, command_ = "run", stop_at_;
  std::vector<std::string> flags_, arguments_;
  std::vector<std::vector<std::string>> again_;
  std::vector<Directive> checks_;
  int exit_ = 0;
  bool failed_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: run_script PROGRAM SCRIPT\n");
    return 2;
  }
  return ScriptCase(argv[1], argv[2]).holds() ? 0 : 1;
}
