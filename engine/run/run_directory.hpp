// SPDX-License-Identifier: GPL-3.0-or-later
// The directory of a run: script.lua, manifest.json, journal.jsonl, one CSV per notebook, the folder `store`
// and the files of the script. Manifests of equal runs have equal bytes except their member "unhashed"
// (dates, machine, threads, place). A resumed run repeats its script, loads stored results and compares
// itself with the journal. A manifest with `done` reaches the disk last. The run's own files are never
// written through a link. A loose run has no directory: names are relative to the working directory. A dry
// run (`asperity check`) writes nothing.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/expectation.hpp"
#include "engine/run/journal.hpp"
#include "engine/run/notebook.hpp"
#include "engine/run/run_folder.hpp"

namespace asperity {

struct RunSetup {
  std::string script_name;  // as given: "examples/fig9.lua"
  std::string script_text;
  std::optional<std::filesystem::path> out;  // missing or empty; default runs/<script>-<n>
  // An interrupted run to continue, instead of `out`. `anew`: the files of an earlier run with another script
  // are moved into before-<n>.
  std::optional<std::filesystem::path> resume;
  bool anew = false;
  bool journal_lost = false;      // and begins again
  std::shared_ptr<RunLock> lock;  // if taken already
  // No lasting files (timed repetitions, other ranks): no lock, no sync.
  bool scratch = false;
  std::filesystem::path runs = "runs";  // parent of default directories
  bool trusted = false;
  std::vector<std::string> arguments;
  std::int64_t seed = 1;
  int threads = 1;
  // Shared folder of results, and share of the cases, "1/3" or "".
  std::string store, shard;
  Json knobs{};                    // given_knobs_json()
  Json versions = Json::object();  // program, libraries, compiler
  Json barriers{};                 // confined run: with readable folders
};

// `shard`: own cases are done, others missing.
enum class RunStatus { running, done, shard, failed, interrupted, killed };
std::string_view name(RunStatus status);

// Thread-safe.
class RunDirectory {
 public:
  // Throws Error{bad_value} if `out` holds more than a run before its first manifest, Error{bad_state} for a
  // locked directory, Error{bad_file} if it cannot be made.
  explicit RunDirectory(const RunSetup& setup);
  // Makes the directory for the first file; `text` returns the script.
  RunDirectory(RunSetup setup, std::function<std::string()> text);
  enum class Without { loose, dry };
  explicit RunDirectory(Without kind, bool trusted = false);

  bool repeating() const { return journal_->repeating(); }
  // Makes and locks the directory for another process, which inherits the lock. The folder of `resume` may be
  // missing; without a run, or read-only, it is not locked. Throws as the constructor does.
  struct Prepared {
    std::filesystem::path path;
    std::shared_ptr<RunLock> lock;  // may be null
    bool made = false;
    // Removes a new directory without run; unlocks.
    void leave();
  };
  static Prepared prepared_for(const RunSetup& setup);

  std::filesystem::path store() const { return root_ / run_names::store; }
  // A sentence on a file system without locks; else "".
  std::string lock_notice() const { return lock_ ? lock_->notice() : std::string(); }
  bool mended() const { return mended_; }
  std::vector<std::filesystem::path> needed_to_resume() const;

  // Empty for loose and dry runs, and before the first file.
  const std::filesystem::path& path() const { return root_; }
  bool trusted() const { return trusted_; }
  bool dry() const { return kind_ == Kind::dry; }

  // Place of an output, relative to the directory; makes its folders. Throws Error{not_permitted} for a way
  // out (absolute path, `..`, link) unless trusted, and for the run's own files; Error{bad_value} for an
  // empty name or a folder; Error{bad_file} if a folder cannot be made.
  std::filesystem::path path_for(std::string_view file);

  // Notes the existing outputs, to detect a removal by another program.
  void see_outputs();
  // `place`: from path_for().
  void forget_output(const std::filesystem::path& place);

  // The run's own file, else a file in the working directory.
  std::filesystem::path place_to_read(std::string_view file) const;

  std::vector<std::string> written() const;

  Journal& journal() { return *journal_; }
  // One object per name. Throws Error{bad_value} for an empty name.
  std::shared_ptr<Notebook> notebook(std::string_view name);
  ExpectationLog& expectations() { return expectations_; }
  // Journal event "expect", and a log entry. Throws as evaluate() does.
  Verdict expect(const Expectation& expectation, const Table& table, std::string_view name);

  struct Findings {
    std::vector<std::shared_ptr<Notebook>> notebooks;
    std::vector<Verdict> verdicts;
  };
  // Takes all notebooks and verdicts out; journal event "again".
  Findings set_aside();
  // Undoes set_aside(), including the files, after a failed repetition.
  void put_back(Findings findings);

  // `call` writes further files before the final manifest, except after a limit or a stop. Set before other
  // threads use the directory.
  void before_its_end(std::function<void()> call) { before_end_ = std::move(call); }

  // For the manifest.
  void note(std::string_view key, Json value);
  // Records an input; rewrites the manifest after an eighth more inputs. True if the resumed run had read
  // other content.
  bool note_input(std::string_view file, std::int64_t bytes, std::string_view digest,
                  const std::string& copy = {});
  // Also copied into `script_files` for replay and resume.
  void note_loaded(std::string_view file, const std::string& text);
  // Name inside the directory; else "".
  std::string own_name(const std::filesystem::path& place) const;

  // Saves notebooks, closes the journal with an event "end" and writes the manifest. False after the first
  // call. May run during a write (watchdog): waits at most `patience` per file, then leaves the file as it
  // is. With status done or failed, all files reach the disk before the manifest; then unlocks. Throws
  // Error{bad_file} after all steps, with status failed, also if another program removed an output or altered
  // script or journal, or a mended run has other outputs. Writes nothing if the directory was moved.
  bool finish(RunStatus status, std::string_view reason = {},
              std::chrono::milliseconds patience = std::chrono::seconds(2));

 private:
  enum class Kind { directory, loose, dry };
  // Until a run is mended.
  static constexpr std::string_view mending_member = "recorded_outputs";
  void make(const RunSetup& setup);
  void begin(const RunSetup& setup);
  void take_up();
  void write_manifest(Durable durable);
  Json inputs() const;
  void wait_for_outputs(const Json& outputs) const;
  void require_recorded(const Json& outputs) const;
  void require_place() const;
  void require_own_files() const;
  void require_present() const;
  void note_end(RunStatus status, std::string_view reason, Json files);
  Json outputs(bool with_digests) const;
  void keep_inside(const std::filesystem::path& relative, std::string_view file) const;

  Kind kind_ = Kind::directory;
  bool trusted_ = false;
  std::filesystem::path root_;
  std::shared_ptr<RunLock> lock_;
  bool scratch_ = false;
  std::string script_text_;
  std::pair<std::uint64_t, std::uint64_t> place_;                     // device, inode
  std::vector<std::filesystem::path> holding_;                        // parents of new folders
  std::vector<std::pair<std::string, std::string>> recorded_inputs_;  // of a resumed run: files, digests
  Json recorded_outputs_;                                             // during mending; else null
  bool mended_ = false;
  std::unique_ptr<Journal> journal_;
  ExpectationLog expectations_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();

  // For a run without a directory yet.
  std::optional<RunSetup> later_;
  std::function<std::string()> text_;

  mutable std::mutex mutex_;  // guards all below
  Json manifest_ = Json::object();
  Json unhashed_ = Json::object();
  std::set<std::string> outputs_, unseen_;  // given out; not yet on the disk
  std::atomic<bool> some_unseen_{false};
  struct Input {
    std::string file;
    std::int64_t bytes;
    std::string digest;
    std::string copy;  // of a script file
    auto operator<=>(const Input&) const = default;
  };
  std::set<Input> inputs_;
  std::size_t inputs_on_disk_ = 0;  // in the manifest
  std::vector<std::shared_ptr<Notebook>> notebooks_;
  std::atomic<bool> finished_{false};
  std::function<void()> before_end_;
};

}  // namespace asperity
