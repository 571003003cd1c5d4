// SPDX-License-Identifier: GPL-3.0-or-later
// Where a run writes: a directory with script.lua (a copy of the text), manifest.json (what ran, with
// what, and how it ended), journal.jsonl, one CSV a notebook, and whatever the script writes itself.
// The manifest is the same bytes for equal runs apart from its member "unhashed" (dates, machine,
// threads, place). Files are kept inside: a name that leads out is refused unless the run is trusted.
// The folder `store` keeps the results of its heavy calls (result_files.hpp): a run that is resumed
// repeats its script, finds them there, and checks itself against the journal as far as that goes.
// The directory is locked (run_lock.hpp) from its making to the end of the run, and a run whose manifest says
// `done` is on the disk: journal and outputs first, then their folders, the manifest last. The run's own
// files are never written through a link. A run that is made later has its directory from the first file on
// that the script writes: until then nothing is made and no journal is kept. Its text, which grows while it
// runs, is asked for when the directory is made and when it ends. A loose run has no directory: names are
// relative to the working directory and neither manifest nor journal is kept. A dry one (`asperity check`)
// resolves names and keeps notebooks, and writes nothing.
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
#include "engine/run/expectation_log.hpp"
#include "engine/run/journal.hpp"
#include "engine/run/notebook.hpp"
#include "engine/run/run_folder.hpp"
#include "engine/run/run_lock.hpp"

namespace asperity {

struct RunSetup {
  std::string script_name;  // as given: "examples/fig9.lua"
  std::string script_text;
  std::optional<std::filesystem::path> out;  // must be missing or empty; default runs/<script>-<n>
  // Instead of `out`: the directory of a run that was cut off, of the same script, arguments and seed, which
  // goes on there; or, with `anew`, of another script, whose files are moved into before-<n>.
  std::optional<std::filesystem::path> resume;
  bool anew = false;
  bool journal_lost = false;      // of a run that is resumed: its journal is damaged or gone, and begun again
  std::shared_ptr<RunLock> lock;  // of the directory, where it was taken already
  // Of which nothing will remain (repeated runs that are timed, ranks that do not lead): nothing is locked,
  // and the disk is not waited for.
  bool scratch = false;
  std::filesystem::path runs = "runs";  // where the default goes
  bool trusted = false;
  std::vector<std::string> arguments;
  std::int64_t seed = 1;
  int threads = 1;
  // The folder that the run shares with others, and its share of the cases, "1/3", where it has one: a run
  // that is resumed takes them from its manifest.
  std::string store, shard;
  Json knobs{};                    // given_knobs_json() of what was given; null for none
  Json versions = Json::object();  // program, libraries, compiler
  Json barriers{};  // what held a confined run and what it could read; null for one that was not confined
};

// `shard`: a share of the cases is done, and the script needs the others.
enum class RunStatus { running, done, shard, failed, interrupted, killed };
std::string_view name(RunStatus status);

// Thread-safe.
class RunDirectory {
 public:
  // Makes the directory and its first files. Throws Error{bad_value} if `out` is there and holds more than a
  // run that had not begun, Error{bad_state} where another process has its lock, Error{bad_file} if it cannot
  // be made.
  explicit RunDirectory(const RunSetup& setup);
  // Makes the directory when the first file is written; `text` gives that of the script so far.
  RunDirectory(RunSetup setup, std::function<std::string()> text);
  enum class Without { loose, dry };
  explicit RunDirectory(Without kind, bool trusted = false);
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  // Of a run that is resumed: whether it is still where it had been before.
  bool repeating() const { return journal_->repeating(); }
  // The directory of a run that another process will be, made and locked as the constructor would: that one
  // is given it as `out` or `resume`, and inherits the lock. `resume` may name a folder that is not there
  // yet; one that holds something else than a run, or cannot be written, is left as it is, without a lock.
  // Throws as the constructor does.
  struct Prepared {
    std::filesystem::path path;
    std::shared_ptr<RunLock> lock;  // may be null
    bool made = false;
    // Takes away what was made here, if nothing was begun in it since, and gives the lock back.
    void leave();
  };
  static Prepared prepared_for(const RunSetup& setup);

  // Where results of heavy calls are kept.
  std::filesystem::path store() const { return root_ / run_names::store; }
  // A sentence where the file system of the directory gives no locks; "" otherwise.
  std::string lock_notice() const { return lock_ ? lock_->notice() : std::string(); }
  // Whether it is a finished run that was resumed because something of it was damaged, and is done again.
  bool mended() const { return mended_; }
  // The files, and the folder they are in, without which the run cannot be resumed.
  std::vector<std::filesystem::path> needed_to_resume() const;

  // Empty for loose and dry runs, and for one that is made later until it is.
  const std::filesystem::path& path() const { return root_; }
  bool trusted() const { return trusted_; }
  bool dry() const { return kind_ == Kind::dry; }

  // The place of a file that the script is about to write; the folders above it are made. Relative
  // names go under the directory. Throws Error{not_permitted} for a way out (an absolute path, `..`,
  // a link) unless trusted, and always for script.lua, manifest.json, journal.jsonl, .lock and what is under
  // store or .views; Error{bad_value} for an empty name or a folder; Error{bad_file} if a folder cannot be
  // made. The file is listed among the outputs if it is there when the run ends.
  std::filesystem::path path_for(std::string_view file);

  // Notes the outputs on the disk. If one of them is missing at the end, another program removed it.
  void see_outputs();
  // The script itself removed or renamed a file; `place` is what path_for() returned.
  void forget_output(const std::filesystem::path& place);

  // Where a file that the script is about to read lies: the one that the run itself wrote under that name,
  // else as named, from the working directory.
  std::filesystem::path place_to_read(std::string_view file) const;

  // Names of the files that the script has written so far, as they will be listed.
  std::vector<std::string> written() const;

  Journal& journal() { return *journal_; }
  // The notebook of that name, the same one each time. Throws Error{bad_value} for an empty name.
  std::shared_ptr<Notebook> notebook(std::string_view name);
  ExpectationLog& expectations() { return expectations_; }

  // What a script that is run again from its start, in the same directory, makes anew.
  struct Findings {
    std::vector<std::shared_ptr<Notebook>> notebooks;
    std::vector<Verdict> verdicts;
  };
  // Takes notebooks and verdicts out: a notebook that is asked for now begins without rows. The journal goes
  // on, with an event "again".
  Findings set_aside();
  // In the place of those made since: what began again came to nothing. The files are as they were.
  void put_back(Findings findings);

  // Called before a run that comes to its own end is written down as such: what else must be on the disk
  // then. Set before others use the directory.
  void before_its_end(std::function<void()> call) { before_end_ = std::move(call); }

  // A member of the manifest; `unhashed` for what may differ between equal runs. Written by finish().
  void note(std::string_view key, Json value);
  void note_unhashed(std::string_view key, Json value);
  // A file that was read, under the name the script gave, with the digest of its content. The
  // manifest tells of it while the run goes on (of many files in eighths of what there are), so that a run
  // that is resumed knows it. Returns whether that one had read other content.
  bool note_input(std::string_view file, std::int64_t bytes, std::string_view digest,
                  const std::string& copy = {});
  // The same of a script file that was loaded. Its text is copied into the folder `script_files`, from which
  // a replay, and a run that is resumed, load it again.
  void note_loaded(std::string_view file, const std::string& text);
  // The name in the directory of a place there; "" of any other place.
  std::string own_name(const std::filesystem::path& place) const;

  // Ends the run: brings notebooks up to date, closes the journal with an event "end", and writes the
  // manifest with the status, outputs and verdicts. The first call counts; returns false for later
  // ones. May be called by a watchdog while another thread is in a write: waits at most `patience`
  // for each file, then leaves that one as it is on disk, which is whole. `reason` says why a run
  // did not end as done. What is done or failed is on the disk before the manifest says so, and the lock is
  // given back. Throws Error{bad_file} after having tried everything, in which case nothing is done: the
  // manifest says failed; the same where others removed an output, or removed or altered script or journal,
  // and where a run that was resumed to mend it did not make its outputs as they were. Nothing is written
  // where the directory was moved.
  bool finish(RunStatus status, std::string_view reason = {},
              std::chrono::milliseconds patience = std::chrono::seconds(2));

 private:
  enum class Kind { directory, loose, dry };
  // Of the manifest, until a run is mended: what its outputs are to be again.
  static constexpr std::string_view mending_member = "recorded_outputs";
  void make(const RunSetup& setup);
  void begin(const RunSetup& setup);
  void take_up();
  void write_manifest(Durable durable);
  Json inputs() const;
  void wait_for_outputs(const Json& outputs) const;
  std::string unlike_recorded(const Json& outputs) const;
  void require_place() const;
  void require_own_files() const;
  std::string removed_by_others() const;
  void note_end(RunStatus status, std::string_view reason, Json files);
  Json outputs(bool with_digests) const;
  void keep_inside(const std::filesystem::path& relative, std::string_view file) const;

  Kind kind_ = Kind::directory;
  bool trusted_ = false;
  std::filesystem::path root_;
  std::shared_ptr<RunLock> lock_;
  bool scratch_ = false;
  std::string script_text_;
  std::pair<std::uint64_t, std::uint64_t> place_;  // device and number of the directory
  std::vector<std::filesystem::path> holding_;  // folders in which one was made on the way to the directory
  std::vector<std::pair<std::string, std::string>> recorded_inputs_;  // of a resumed run: files, digests
  Json recorded_outputs_;  // of a finished run that is mended; else null
  bool mended_ = false;
  std::unique_ptr<Journal> journal_;
  ExpectationLog expectations_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();

  // Of a run that is made later, until it is; and the text it keeps.
  std::optional<RunSetup> later_;
  std::function<std::string()> text_;

  mutable std::mutex mutex_;  // of everything below
  Json manifest_ = Json::object();
  Json unhashed_ = Json::object();
  std::set<std::string> outputs_, unseen_;  // given to the script; of them, not yet met on the disk
  std::atomic<bool> some_unseen_{false};
  struct Input {
    std::string file;
    std::int64_t bytes;
    std::string digest;
    std::string copy;  // of a script file; else empty
    auto operator<=>(const Input&) const = default;
  };
  std::set<Input> inputs_;
  std::size_t inputs_on_disk_ = 0;  // how many of them the manifest tells of while the run goes on
  std::vector<std::shared_ptr<Notebook>> notebooks_;
  std::atomic<bool> finished_{false};
  std::function<void()> before_end_;
};

}  // namespace asperity
