// SPDX-License-Identifier: GPL-3.0-or-later
// Environment of a Lua state, in its registry: monitor, seed, limits and recorded run (none in a case).
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
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"
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
struct Refinement;
class Session;
class Variation;

// The script's name on the command line; results must not depend on it.
struct ScriptSpelling {
  std::string path;
  std::string folder;  // of `require`: "."; "" without a script
};

// A case's inputs besides its arguments: files, knobs and random numbers. A stored result requires equal
// inputs.

// A file that a case read or looked for; no digest if missing. Files found by `require` in the script's
// folder are named relative to it, because runs may have different folders.
struct CaseInput {
  std::string file;
  std::int64_t bytes = 0;
  std::string digest;
  std::string beside_script = {};  // "helper.lua"; else empty
  bool loaded = false;             // by `require`, `dofile` or `loadfile`
};
CaseInput input_of_case(const std::string& file);
// Empty if the file is missing.
std::string present_digest(const std::string& file);
// For replay and resume; null if none.
const LoadedFile* recorded_copy(const std::shared_ptr<const LoadedFiles>& loaded, const std::string& file);

// To the run, or to the outer case.
void note_inputs_of_case(const Session& session, const std::vector<CaseInput>& inputs);

struct CaseNotes {
  std::vector<CaseInput> inputs;
  std::vector<RunKnob> knobs;
  bool drew = false;  // the seed matters
};

enum class SharedEnd { stored, failed, missing, no_such_case };

// Options of --store.
struct SharedStore {
  std::string folder;
  std::optional<Shard> shard;     // only this share of the cases
  std::optional<CaseNumber> one;  // or only this case
  bool merge_only = false;        // no case; otherwise all missing cases
  std::function<bool(std::int64_t bytes)> takes;
  // To standard error, outside the record.
  std::function<void(const std::string& sentence)> tell;
  std::function<void(SharedEnd end, const std::string& sentence)> end;
};

// A case takes over these members and has its own seed.
struct SessionSettings {
  std::uint64_t seed = 1;  // for math.random and unseeded calls
  bool trusted = false;    // all of Lua, and files anywhere
  int depth = 0;           // enclosing ensembles
  std::shared_ptr<Ledger> ledger = std::make_shared<Ledger>();
  std::shared_ptr<Refinement> refinement;  // of an accuracy study, else null
  std::shared_ptr<Variation> variation;    // of a replay, else null
  std::shared_ptr<RunKnobs> knobs = std::make_shared<RunKnobs>();
  ScriptSpelling script;  // may be empty
  // Script files of a replay or resume; may be null.
  std::shared_ptr<const LoadedFiles> loaded;
  std::string script_digest;  // of script and arguments, or ""
};

// Gives a variable another value until the end of a scope.
template <class T>
class Temporarily {
 public:
  Temporarily(T& variable, std::type_identity_t<T> value)
      : variable_(variable), before_(std::exchange(variable, std::move(value))) {}
  ~Temporarily() { variable_ = std::move(before_); }
  Temporarily(const Temporarily&) = delete;
  Temporarily& operator=(const Temporarily&) = delete;

 private:
  T& variable_;
  T before_;
};

class Session : public SessionSettings {
 public:
  explicit Session(Monitor& monitor) : monitor_(&monitor) {}

  Monitor& monitor() const { return *monitor_; }

  class Reporting {
   public:
    Reporting(Session& session, Monitor& monitor) : monitor_(session.monitor_, &monitor) {}

   private:
    Temporarily<Monitor*> monitor_;
  };

  struct Running {
    Running(const Session& of, lua_State* in) : session(of), L(in), outer(innermost) { innermost = this; }
    ~Running() { innermost = outer; }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    const Session& session;
    lua_State* L;
    const Running* outer;
    static inline thread_local const Running* innermost = nullptr;
  };

  // Script functions of surfaces, released after their surface.
  struct HeldFunctions {
    std::mutex mutex;
    std::vector<int> released;
  };
  std::shared_ptr<HeldFunctions> held_functions = std::make_shared<HeldFunctions>();

  bool dry_run = false;               // `asperity check`: heavy calls return placeholders
  bool gave_placeholders = false;     // a call was skipped
  bool is_case = false;               // a case of an ensemble: cannot record
  std::shared_ptr<RunDirectory> run;  // may be null
  // `asperity explain` makes surfaces and plans contacts; otherwise null.
  std::shared_ptr<Explanation> explanation;
  // Possibly written by skipped calls.
  std::set<std::string, std::less<>> paths_left_out;
  // For each skipped heavy call; may be empty.
  std::function<void(const Call& call, const Function& function)> on_call_left_out;
  // Null unless a dry run continues after mistakes.
  std::shared_ptr<Mistakes> mistakes;
  // os.exit(code). If it throws Error{interrupted}, the process continues and the script must be interrupted.
  std::function<void(int)> exit_hook;
  bool with_other_ranks = false;       // wait: os.exit is an error
  std::FILE* output = stdout;          // a buffer in a case
  std::map<std::string, int> studies;  // of studies, with counts
  // For lab.knob.set; empty if nothing runs again.
  std::function<void(const std::string& name, const std::string& value)> move_knob;
  int ensembles = 0;                    // started by the script
  std::int64_t heavy_calls = 0;         // computed or found
  int numbered_ensembles = 0;           // in the script, for --case
  const SharedStore* shared = nullptr;  // null: this process only
  // Per ensemble of a dry run; may be empty.
  std::function<void(const std::string& place, std::size_t cases,
                     const std::function<std::string(std::size_t)>& name)>
      on_ensemble;
  // May be empty.
  std::function<void(const std::string& call, const Values& results)> onlooker;
  Ranks* ranks = nullptr;  // may be null
  // Null outside a case.
  CaseNotes* notes = nullptr;
  // Globals that could not be copied, with reasons; null outside a case.
  const std::map<std::string, std::string>* left_behind = nullptr;

  // Unless `lasting`, for slow calls only.
  LedgerScope ledger_scope(std::string_view call, bool lasting, std::string_view owner = {}) const {
    return LedgerScope(*ledger, owner, call, is_case, lasting);
  }

  // May run a collection.
  void nudge_collector(lua_State* L, std::size_t bytes);

  static Session& of(lua_State* L);
  // Null if no session was attached.
  static Session* find(lua_State* L);
  // The session must outlive the state. Raises on lack of memory.
  static void attach(lua_State* L, Session& session);

 private:
  Monitor* monitor_;
  std::size_t unseen_bytes_ = 0;
};

}  // namespace asperity::lua
