// SPDX-License-Identifier: GPL-3.0-or-later
// The ranks of `mpirun -n K asperity run SCRIPT`, by messages of MPI. Nothing of MPI is loaded unless the
// environment says that this process is one of several that mpirun started.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bindings/cli/shard.hpp"
#include "engine/core/files/temporary_folder.hpp"
#include "engine/run/ranks.hpp"

struct AsperityMpi;

namespace asperity::cli {

// The rank that the launcher gave to this process, before MPI starts; none for a single process. Tasks of
// srun are single processes if they `share` a store. Throws Error{bad_value} for tasks that srun started
// without MPI.
struct LaunchedRank {
  int rank = 0, size = 1;
  int on_this_machine = 1;
};
std::optional<LaunchedRank> launched_rank(bool share);
// Default threads of each rank: its processors, divided among the ranks of a machine.
int threads_of(const LaunchedRank& launched);

class MpiRanks final : public Ranks {
 public:
  // Joins the others; the signals of a stop are blocked first, so that no thread of MPI takes them. Throws
  // Error{bad_file} where the program was built without it, Error{bad_value} where MPI joins fewer processes
  // than the launcher `started`.
  explicit MpiRanks(int started);
  ~MpiRanks() override = default;

  Team& team() override;

  // Temporary folder for files of a rank other than 0.
  std::string scratch_folder() const { return scratch_->path().string() + "/run"; }
  void note_failure(const std::string& why) { why_ = why; }

  // The end of the run in this process: waits for the others, and returns the exit status. Where they do not
  // come to their end, ends every process.
  int leave(int status);

 private:
  void send_bytes(int to, const std::string& bytes) override;
  std::optional<std::pair<int, std::string>> receive_bytes() override;
  int leave_leading(int status);
  void leave_following(int status);
  void leave_stopped(int status);

  const AsperityMpi* mpi_ = nullptr;
  std::unique_ptr<Team> team_;              // made when it is first needed
  std::optional<TemporaryFolder> scratch_;  // of every rank but 0
  std::string why_;
};

}  // namespace asperity::cli
