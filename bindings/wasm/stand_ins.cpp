// SPDX-License-Identifier: GPL-3.0-or-later
// A module of WebAssembly starts no process, no thread and no loadable part. This file takes the place of
// bindings/web, bindings/cli/watchdog.cpp and engine/core/loaded_part.cpp, and refuses by name.
#include <elf.h>
#include <link.h>
#include <poll.h>
#include <sched.h>
#include <spawn.h>

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>

#include "bindings/cli/watchdog.hpp"
#include "bindings/web/api/lesson_folder.hpp"
#include "bindings/web/confined/confined_command.hpp"
#include "bindings/web/serve_command.hpp"
#include "engine/contact/elasticity/slabs/slab_solve.hpp"
#include "engine/core/error.hpp"
#include "engine/core/loaded_part.hpp"

// SHA-1 of the libraries, written at build time.
extern const unsigned char asperity_build_id[20];

// Shows the module to core/program_identity.cpp as a file with a build id: stored results name their build.
int dl_iterate_phdr(int (*use)(dl_phdr_info*, std::size_t, void*), void* data) {
  struct {
    ElfW(Nhdr) head{4, sizeof asperity_build_id, NT_GNU_BUILD_ID};
    char owner[4] = "GNU";
    unsigned char id[sizeof asperity_build_id];
  } note;
  std::memcpy(note.id, asperity_build_id, sizeof note.id);
  ElfW(Phdr) parts[2] = {};
  parts[0].p_type = PT_LOAD;
  parts[0].p_memsz = UINT32_MAX;
  parts[1].p_type = PT_NOTE;
  parts[1].p_vaddr = reinterpret_cast<std::uintptr_t>(&note);
  parts[1].p_memsz = sizeof note;
  dl_phdr_info module{};
  module.dlpi_phdr = parts;
  module.dlpi_phnum = 2;
  return use(&module, sizeof module, data);
}

// System calls that the C library declares and does not have: no process starts, one processor, no signals.
extern "C" {
int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                 char* const*, char* const*) {
  return ENOSYS;
}
int sched_getaffinity(pid_t, std::size_t, cpu_set_t*) { return -1; }
int __sched_cpucount(std::size_t, const cpu_set_t*) { return 1; }
int ppoll(pollfd* files, nfds_t count, const timespec* wait, const sigset_t*) {
  return poll(files, count,
              wait == nullptr ? -1 : static_cast<int>(wait->tv_sec * 1000 + wait->tv_nsec / 1000000));
}
}

namespace asperity {

namespace {
[[noreturn]] void refuse_absent(const std::string& sentence, const std::string& cure) {
  refuse_state(sentence + ", which WebAssembly does not have", cure);
}
constexpr const char* native = "use the program that ./lab builds";
}  // namespace

std::vector<std::filesystem::path> part_places(const LoadedPart&) { return {}; }
void* part_symbol(const LoadedPart& part, const char* symbol) { return part_symbol(part, symbol, {}); }
void* part_symbol(const LoadedPart& part, const char*, const std::vector<std::filesystem::path>&) {
  refuse_absent(std::string(part.purpose) + " by the part asperity-" + std::string(part.name), native);
}

// A module is one process.
namespace {
[[noreturn]] void refuse_slabs() { refuse_absent("`lab.spread` needs the processes of mpirun", native); }
}  // namespace
SlabSurface slab_surface(Team&, const Grid&, const SlabRow&, Monitor&) { refuse_slabs(); }
SlabSurface slab_self_affine(Team&, const SelfAffineOptions&, Monitor&) { refuse_slabs(); }
SlabSurface slab_sine(Team&, const SineOptions&, Monitor&) { refuse_slabs(); }
SlabSurface slab_flat(Team&, const Grid&, Monitor&) { refuse_slabs(); }
SlabSurface slab_read(Team&, const std::string&, const SlabFileOptions&, Monitor&) { refuse_slabs(); }
void write_slabs(Team&, const Slab&, const SlabRow&, const std::string&, Monitor&) { refuse_slabs(); }
SlabTerms slab_terms(const std::optional<Material>&, const Material&, const Effects&) { refuse_slabs(); }
SlabContactAnswer solve_slabs_at_pressure(Team&, const SlabContactProblem&, double, const SlabContactAnswer*,
                                          Monitor&) {
  refuse_slabs();
}
SlabContactAnswer solve_slabs_at_approach(Team&, const SlabContactProblem&, double, Monitor&) {
  refuse_slabs();
}

namespace cli {

// Ctrl-C ends the process, and a page ends its worker. The journal is safe up to the last line, and
// `run --resume` continues.
Watchdog::Watchdog(std::optional<double> limit_seconds, std::function<void(StopReason)>, CtrlC ctrl_c)
    : ctrl_c_(ctrl_c) {
  if (limit_seconds)
    refuse_absent("`--limit-time` needs threads", "leave it out, and stop a long run by Ctrl-C");
}
Watchdog::~Watchdog() = default;
void Watchdog::watch(lua_State* L) { state_ = L; }

const sigset_t& stop_signals() {
  static const sigset_t none{};
  return none;
}
int exit_status(StopReason) { return failed; }

}  // namespace cli

namespace web {

int confined_main() { return cli::bad_usage; }
bool to_be_confined(const cli::RunCommand& command) { return command.confined; }
bool to_be_confined(const cli::ReplayCommand& command) { return command.run.confined; }
int run_behind_barriers(const cli::RunCommand&) { refuse_absent("`--confined` needs a process", native); }
int replay_behind_barriers(const cli::ReplayCommand&) {
  refuse_absent("`--confined` needs a process", native);
}

std::vector<lua::Lesson> lessons_with(const std::filesystem::path& folder) {
  if (!folder.empty()) refuse_absent("`--lessons` needs the file functions of Linux", native);
  return lua::lessons();
}

cli::Command serve_command() {
  const auto refused = []() -> cli::CommandWork { refuse_absent("`asperity serve` needs a server", native); };
  return {.name = "serve",
          .sentence = "open the laboratory as a page (not in this build)",
          .overview = "",
          .declare = [refused](CLI::App&) -> cli::CommandReader { return refused; }};
}

}  // namespace web
}  // namespace asperity
