// SPDX-License-Identifier: GPL-3.0-or-later
// What a process that works for somebody else may do: a script of the page, or gnuplot on numbers of such a
// script. It is the process itself that goes behind the barriers, before it reads a byte of what it is to
// run, and there is no way back. Each barrier is of the operating system and none knows of Lua: a flaw of the
// language's own limits meets them all. Linux only; a kernel that lacks one is met by the others.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace asperity::web {

enum class Confined {
  script,   // its working directory, or the folders that were named, and no other file; no other program,
            // process or network
  drawing,  // besides, one program, /usr/bin/gnuplot, and what it reads of /usr and of the fonts
};

// How confine() names the tree of files of the process's own.
inline constexpr const char* own_root_barrier = "a root of its own";

// A folder that a script may reach, with all below it.
struct Place {
  std::string folder;     // where it is: absolute and without links, or "." for the working directory
  std::string seen;       // where the script finds it in a root of its own; absolute
  bool write = false;     // files in it may also be made, changed and removed
  bool programs = false;  // in it may be run, and loaded
};

struct Confinement {
  Confined as = Confined::script;
  std::vector<Place> places{};  // of a script; none: the working directory alone, which it finds as /run
  std::string work{};  // the folder that it works in then, which it may not list unless it is a place
  std::int64_t memory_bytes = std::int64_t{1} << 30;  // of data; half a GiB more for what libraries hold
  std::int64_t file_bytes = std::int64_t{64} << 20;   // of one file
  std::int64_t processor_seconds = 60;                // of all its threads together
  int threads = 1;                                    // it means to use
  std::int64_t parent = 0;  // the process that it does not outlive; 0: its parent when confine() is called
};

// One way out, and what stands in it.
struct Barrier {
  std::string name;      // "files"
  std::string sentence;  // "no file outside its directory can be opened"
  bool holds = false;
  std::string by;  // "Landlock 4, a root of its own"; where nothing holds, why
};

// Sets up every barrier that the kernel offers, for this process, its threads and what it becomes. Must be
// called while there is one thread. Returns how each was put up, in words ("Landlock 4"), and leaves out what
// the kernel does not offer; `missing` gets those, with the reason. Throws Error{bad_state} where a limit
// cannot be set.
std::vector<std::string> confine(const Confinement& confinement, std::vector<std::string>& missing);

// Tries, in a confined process, what must not succeed, and says of each way out whether it is shut. Harmless
// where it is not.
std::vector<Barrier> try_barriers();

}  // namespace asperity::web
