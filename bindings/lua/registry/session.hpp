// SPDX-License-Identifier: GPL-3.0-or-later
// The surroundings of a Lua state: its monitor, seed and limits, and the run with its results.
// Every state has exactly one, held in the registry; the states of an ensemble's cases have one
// each, with no run of their own.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/script_spelling.hpp"
#include "bindings/lua/registry/value.hpp"
#include "engine/core/monitor.hpp"
#include "engine/run/case_scheduler.hpp"
#include "engine/run/ledger.hpp"
#include "engine/run/recorded_run.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity {
class RunDirectory;
}

namespace asperity::lua {

class Call;
class Explanation;
struct Function;
class Mistakes;
struct CaseNotes;
struct Refinement;
class Variation;

// End of a process that shares its cases with others.
enum class SharedEnd { stored, failed, missing, no_such_case };

// The shared folder of results (--store), and the part of this process.
struct SharedStore {
  std::string folder;             // as given
  std::optional<Shard> shard;     // it computes this share of the cases
  std::optional<CaseNumber> one;  // or this case
  bool merge_only = false;        // or no case; else all that are missing
  // Whether a file of so many bytes fits the limit of the folder.
  std::function<bool(std::int64_t bytes)> takes;
  // Says a sentence on standard error, outside the record.
  std::function<void(const std::string& sentence)> tell;
  // Ends the process.
  std::function<void(SharedEnd end, const std::string& sentence)> end;
};

class Session {
 public:
  explicit Session(Monitor& monitor) : monitor_(&monitor) {}

  Monitor& monitor() const { return *monitor_; }

  // Reports to another monitor during a part of longer work.
  class Reporting {
   public:
    Reporting(Session& session, Monitor& monitor) : session_(session), outer_(session.monitor_) {
      session_.monitor_ = &monitor;
    }
    ~Reporting() { session_.monitor_ = outer_; }
    Reporting(const Reporting&) = delete;
    Reporting& operator=(const Reporting&) = delete;

   private:
    Session& session_;
    Monitor* outer_;
  };

  // Is alive while a native function of a state runs, and gives the innermost one on this thread.
  struct Running {
    Running(const Session& of, lua_State* in) : session(of), L(in), outer(innermost) { innermost = this; }
    ~Running() { innermost = outer; }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    const Session& session;
    lua_State* L;
    const Running* outer;
    static thread_local const Running* innermost;
  };

  // Functions of the script held by surfaces; the place of a function waits here for release after its
  // surface.
  struct HeldFunctions {
    std::mutex mutex;
    std::vector<int> released;
  };
  std::shared_ptr<HeldFunctions> held_functions = std::make_shared<HeldFunctions>();

  std::uint64_t seed = 1;             // of math.random and of anything a script leaves to the run
  bool dry_run = false;               // asperity check: heavy calls give placeholders
  bool gave_placeholders = false;     // a dry run has met a call it did not make
  bool trusted = false;               // the whole of Lua, and files anywhere
  int depth = 0;                      // ensembles this state stands inside
  bool is_case = false;               // a case of an ensemble: cannot record
  std::shared_ptr<RunDirectory> run;  // null when nothing is recorded
  // `asperity explain`, a dry run that makes surfaces and plans contacts, collects here what the script will
  // compute; null in every other run.
  std::shared_ptr<Explanation> explanation;
  // Paths in the calls that a dry run leaves out: the script may have written these files.
  std::set<std::string, std::less<>> paths_left_out;
  // Called for each heavy call that a dry run leaves out; may be empty.
  std::function<void(const Call& call, const Function& function)> on_call_left_out;
  // The mistakes of a dry run that goes on past them; null in every other run.
  std::shared_ptr<Mistakes> mistakes;
  // What the calls of this state cost; the states of an ensemble's cases share the ledger of the ensemble.
  std::shared_ptr<Ledger> ledger = std::make_shared<Ledger>();
  // What os.exit(code) does before the process ends; where it throws Error{interrupted} the process does not,
  // and the script must have been interrupted.
  std::function<void(int)> exit_hook;
  bool with_other_ranks = false;           // in a function that other ranks wait for: os.exit is an error
  std::FILE* output = stdout;              // where print goes; a buffer in a case
  std::map<std::string, int> studies;      // names given to studies of work and precision, and how often
  std::shared_ptr<Refinement> refinement;  // of a script that a study of accuracy runs again; may be null
  std::shared_ptr<Variation> variation;  // of a recorded run that is run again with other values; may be null
  // The numbers that the script asks whoever runs it for; the states of cases share those of their ensemble.
  std::shared_ptr<RunKnobs> knobs = std::make_shared<RunKnobs>();
  // Called by lab.knob.set with an accepted value; empty if nothing runs again.
  std::function<void(const std::string& name, const std::string& value)> move_knob;
  ScriptSpelling script;  // as it was named; empty where there is none
  // The script files of a replayed or resumed run, which are loaded again; may be null.
  std::shared_ptr<const LoadedFiles> loaded;
  std::string script_digest;     // of the text of the script and its arguments; may be empty
  int ensembles = 0;             // that the script has begun
  std::int64_t heavy_calls = 0;  // that this state has made; computed or found in the store, they count alike
  int numbered_ensembles = 0;    // calls of lab.ensemble by the script itself, as --case counts them
  const SharedStore* shared = nullptr;  // null: no other process computes cases of this run
  // A dry run calls this for each ensemble, with its place, the number of cases and their names; may be
  // empty.
  std::function<void(const std::string& place, std::size_t cases,
                     const std::function<std::string(std::size_t)>& name)>
      on_ensemble;
  // Called with the results of each heavy call; may be empty.
  std::function<void(const std::string& call, const Values& results)> onlooker;
  Ranks* ranks = nullptr;  // the processes that share the cases; may be null
  // Inputs of a case besides its arguments; null outside a case.
  CaseNotes* notes = nullptr;
  // The script's globals that could not be copied into the state of a case, and why; null outside a case.
  const std::map<std::string, std::string>* left_behind = nullptr;

  // The ledger's scope of a call that begins here. A call that is not `lasting` gets a line in the ledger
  // only if it takes long enough to matter.
  LedgerScope ledger_scope(std::string_view call, bool lasting, std::string_view owner = {}) const {
    return LedgerScope(*ledger, owner, call, is_case, lasting);
  }

  // Tells Lua's collector about memory it cannot see; collects when enough has piled up.
  void nudge_collector(lua_State* L, std::size_t bytes);

  static Session& of(lua_State* L);
  // Null for a state that was never given one.
  static Session* find(lua_State* L);
  // Binds a session to a state; the session must outlive it. Raises on lack of memory.
  static void attach(lua_State* L, Session& session);

 private:
  Monitor* monitor_;
  std::size_t unseen_bytes_ = 0;
};

}  // namespace asperity::lua
