// SPDX-License-Identifier: GPL-3.0-or-later
// Confinement of a process that works for somebody else: a page's script, or gnuplot with numbers from such a
// script. The process confines itself before it reads a byte of its input, and cannot undo this. All barriers
// belong to the operating system and know nothing of Lua, so that a flaw of Lua's own limits meets every
// barrier. Linux only; if a kernel lacks one barrier, the others remain.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace asperity::web {

enum class Confined {
  script,   // the working directory or the named folders; no other file, program, process or network
  drawing,  // also one program, /usr/bin/gnuplot, and its files in /usr and the fonts
};

// The name of the process's own root in confine().
inline constexpr const char* own_root_barrier = "a root of its own";

// A folder within reach of a script, with everything below.
struct Place {
  std::string folder;     // absolute and without links, or "." for the working directory
  std::string seen;       // absolute path of the folder in the own root
  bool write = false;     // files may be created, changed and removed
  bool programs = false;  // files may be executed and loaded
};

struct Confinement {
  Confined as = Confined::script;
  std::vector<Place> places{};  // of a script; none: only the working directory, as /run
  std::string work{};           // the working folder, unlisted unless it is a place
  std::int64_t memory_bytes = std::int64_t{1} << 30;  // data; plus half a GiB for libraries
  std::int64_t file_bytes = std::int64_t{64} << 20;   // of one file
  std::int64_t processor_seconds = 60;                // all threads together
  int threads = 1;                                    // intended threads
  std::int64_t parent = 0;  // the process dies with this parent; 0: the parent at the call of confine()
};

// One way out and its barrier.
struct Barrier {
  std::string name;      // "files"
  std::string sentence;  // "no file outside its directory can be opened"
  bool holds = false;
  std::string by;  // "Landlock 4, a root of its own"; without a barrier, the reason
};

// Sets up every barrier of the kernel for this process, its threads and the programs it executes. Must be
// called while the process has a single thread. Returns the barriers in words ("Landlock 4"); `missing` gets
// the unavailable barriers with reasons. Throws Error{bad_state} if a limit cannot be set.
std::vector<std::string> confine(const Confinement& confinement, std::vector<std::string>& missing);

// In a confined process: tries every forbidden action and reports each way out as closed or open. Harmless if
// a way is open.
std::vector<Barrier> try_barriers();

}  // namespace asperity::web
