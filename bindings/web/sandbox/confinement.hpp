// SPDX-License-Identifier: GPL-3.0-or-later
// Confinement of a process that runs a foreign script, or gnuplot with a script's numbers. The process
// confines itself irrevocably before it reads a byte of its input. All barriers belong to the operating
// system, so they hold when Lua's own limits fail. Linux only; a kernel may lack some barriers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace asperity::web {

enum class Confined {
  script,   // working directory or named folders only
  drawing,  // also /usr/bin/gnuplot, its files in /usr, fonts
};

inline constexpr const char* own_root_barrier = "a root of its own";

// A folder and everything below.
struct Place {
  std::string folder;     // without links, or "."
  std::string seen;       // in the own root
  bool write = false;     // create, change, remove
  bool programs = false;  // execute and load
};

struct Confinement {
  Confined as = Confined::script;
  std::vector<Place> places{};                        // none: the working directory, as /run
  std::string work{};                                 // listed only if a place
  std::int64_t memory_bytes = std::int64_t{1} << 30;  // data; plus 0.5 GiB for libraries
  std::int64_t file_bytes = std::int64_t{64} << 20;   // of one file
  std::int64_t processor_seconds = 60;                // all threads
  int threads = 1;
  std::int64_t parent = 0;  // dies with it; 0: present
};

struct Barrier {
  std::string name;      // "files"
  std::string sentence;  // "no file outside its directory can be opened"
  bool holds = false;
  std::string by;  // or why open
};

// Sets up all barriers of the kernel for this process and its programs. Call with a single thread. Returns
// the barriers ("Landlock 4"); `missing` gets the others with reasons. Throws Error{bad_state} if a limit
// cannot be set.
std::vector<std::string> confine(const Confinement& confinement, std::vector<std::string>& missing);

// The filter of system calls, an allow list for computations, is the part asperity-sandbox.so
// (bindings/web/seccomp), loaded before files are hidden. Both return the reason of a failure, or "".
std::string load_system_call_filter();
std::string confine_system_calls(Confined as);
// Symbol `asperity_confine_system_calls` of the part: reason of a failure, or null.
using ConfineSystemCalls = const char*(Confined as);

// In a confined process: tries every forbidden action, harmlessly.
std::vector<Barrier> try_barriers();

}  // namespace asperity::web
