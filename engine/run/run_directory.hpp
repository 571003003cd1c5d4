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
  // Instead of `out`: the directory of an interrupted run with the same script, arguments and seed, which the
  // run continues. With `anew`, the run in this directory had another script: its files are moved into
  // before-<n>.
  std::optional<std::filesystem::path> resume;
  bool anew = false;
  bool journal_lost = false;      // the journal of the resumed run is damaged or missing, and begun again
  std::shared_ptr<RunLock> lock;  // of the directory, where it was taken already
  // A run without lasting files (timed repetitions, ranks other than the first): nothing is locked, and
  // nobody waits for the disk.
  bool scratch = false;
  std::filesystem::path runs = "runs";  // where the default goes
  bool trusted = false;
  std::vector<std::string> arguments;
  std::int64_t seed = 1;
  int threads = 1;
  // The folder of results shared with other runs, and the share of the cases, such as "1/3", or "". A resumed
  // run takes both from its manifest.
  std::string store, shard;
  Json knobs{};                    // given_knobs_json() of the given knobs; null for none
  Json versions = Json::object();  // program, libraries, compiler
  Json barriers{};                 // barriers and readable folders of a confined run; else null
};

// `shard`: a share of the cases is done, and the script needs the others.
enum class RunStatus { running, done, shard, failed, interrupted, killed };
std::string_view name(RunStatus status);

// Thread-safe.
class RunDirectory {
 public:
  // Makes the directory and its first files. Throws Error{bad_value} if `out` exists and holds more than a
  // run before its first manifest, Error{bad_state} where another process has its lock, Error{bad_file} if it
  // cannot be made.
  explicit RunDirectory(const RunSetup& setup);
  // Makes the directory when the first file is written; `text` returns the text of the script so far.
  RunDirectory(RunSetup setup, std::function<std::string()> text);
  enum class Without { loose, dry };
  explicit RunDirectory(Without kind, bool trusted = false);
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  // Whether a resumed run still repeats its earlier part.
  bool repeating() const { return journal_->repeating(); }
  // The directory of a run that another process will be, made and locked as the constructor would: that one
  // is given it as `out` or `resume`, and inherits the lock. `resume` may name a folder that is not there
  // yet; one that holds something else than a run, or cannot be written, is left as it is, without a lock.
  // Throws as the constructor does.
  struct Prepared {
    std::filesystem::path path;
    std::shared_ptr<RunLock> lock;  // may be null
    bool made = false;
    // Removes the new directory, if no run has begun in it, and releases the lock.
    void leave();
  };
  static Prepared prepared_for(const RunSetup& setup);

  // The folder with the results of heavy calls.
  std::filesystem::path store() const { return root_ / run_names::store; }
  // A sentence where the file system of the directory gives no locks; "" otherwise.
  std::string lock_notice() const { return lock_ ? lock_->notice() : std::string(); }
  // Whether a damaged finished run was resumed and is done again.
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

  // Notes the outputs on the disk. An output missing at the end was removed by another program.
  void see_outputs();
  // The script itself removed or renamed a file; `place` is the path from path_for().
  void forget_output(const std::filesystem::path& place);

  // The place of a file to be read by the script: the run's own file of this name, else the name from the
  // working directory.
  std::filesystem::path place_to_read(std::string_view file) const;

  // Names of the files that the script has written so far, as they will be listed.
  std::vector<std::string> written() const;

  Journal& journal() { return *journal_; }
  // The notebook of that name, the same one each time. Throws Error{bad_value} for an empty name.
  std::shared_ptr<Notebook> notebook(std::string_view name);
  ExpectationLog& expectations() { return expectations_; }

  // Results made anew when a script runs again from its start in the same directory.
  struct Findings {
    std::vector<std::shared_ptr<Notebook>> notebooks;
    std::vector<Verdict> verdicts;
  };
  // Takes notebooks and verdicts out: new notebooks begin without rows. The journal goes on, with an event
  // "again".
  Findings set_aside();
  // Replaces the newer notebooks and verdicts, because the repetition came to nothing. The files are as they
  // were.
  void put_back(Findings findings);

  // `call` puts further files on the disk before the manifest records the end of the run. It is not called
  // for runs cut off by a limit or a stop. Set it before others use the directory.
  void before_its_end(std::function<void()> call) { before_end_ = std::move(call); }

  // A member of the manifest; `unhashed` for what may differ between equal runs. Written by finish().
  void note(std::string_view key, Json value);
  void note_unhashed(std::string_view key, Json value);
  // Records a file read by the script, under the name in the script, with the digest of its content. The
  // manifest lists the inputs during the run, so that a resumed run knows them; it is rewritten when their
  // number has grown by an eighth. Returns whether the resumed run had read other content.
  bool note_input(std::string_view file, std::int64_t bytes, std::string_view digest,
                  const std::string& copy = {});
  // The same for a loaded script file. Its text is copied into the folder `script_files`; a replay and a
  // resumed run load the copy.
  void note_loaded(std::string_view file, const std::string& text);
  // The name in the directory of a place there; "" of any other place.
  std::string own_name(const std::filesystem::path& place) const;

  // Ends the run: brings notebooks up to date, closes the journal with an event "end", and writes the
  // manifest with the status, outputs and verdicts. The first call counts; returns false for later ones. May
  // be called by a watchdog while another thread is in a write: waits at most `patience` for each file, then
  // leaves that one as it is on disk, which is whole. `reason` says why a run did not end as done. The files
  // are on the disk before the manifest says done or failed, and the lock is released. Throws Error{bad_file}
  // after having tried everything, and the manifest says failed. Other programs that removed an output, or
  // removed or altered script or journal, cause the same error; so does a mended run with other outputs than
  // before. Nothing is written if the directory was moved.
  bool finish(RunStatus status, std::string_view reason = {},
              std::chrono::milliseconds patience = std::chrono::seconds(2));

 private:
  enum class Kind { directory, loose, dry };
  // Member of the manifest until a run is mended: its expected outputs.
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
  Json recorded_outputs_;  // of a finished run during mending; else null
  bool mended_ = false;
  std::unique_ptr<Journal> journal_;
  ExpectationLog expectations_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();

  // Setup and text of a run without a directory yet.
  std::optional<RunSetup> later_;
  std::function<std::string()> text_;

  mutable std::mutex mutex_;  // of everything below
  Json manifest_ = Json::object();
  Json unhashed_ = Json::object();
  std::set<std::string> outputs_, unseen_;  // names given to the script; names not yet seen on the disk
  std::atomic<bool> some_unseen_{false};
  struct Input {
    std::string file;
    std::int64_t bytes;
    std::string digest;
    std::string copy;  // of a script file; else empty
    auto operator<=>(const Input&) const = default;
  };
  std::set<Input> inputs_;
  std::size_t inputs_on_disk_ = 0;  // inputs listed in the manifest during the run
  std::vector<std::shared_ptr<Notebook>> notebooks_;
  std::atomic<bool> finished_{false};
  std::function<void()> before_end_;
};

}  // namespace asperity
