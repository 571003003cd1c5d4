// SPDX-License-Identifier: GPL-3.0-or-later
// The ranks of `mpirun -n K asperity run SCRIPT`. MPI is loaded only after a launch by mpirun.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/core/files/atomic_file.hpp"
#include "engine/run/ranks.hpp"

struct AsperityMpi;

namespace asperity::cli {

// From the launcher's environment; none for a single process, or for srun tasks that `share` a store. Throws
// Error{bad_value} for srun tasks without MPI.
struct LaunchedRank {
  int rank = 0, size = 1;
  int on_this_machine = 1;
};
std::optional<LaunchedRank> launched_rank(bool share);
// Default: the machine's processors divided among its ranks.
int threads_of(const LaunchedRank& launched);

class MpiRanks final : public Ranks {
 public:
  // Starts MPI with stop signals blocked in its threads. Throws Error{bad_file} in a build without MPI,
  // Error{bad_value} if fewer processes join than the launcher `started`.
  explicit MpiRanks(int started);
  ~MpiRanks() override = default;

  Team& team() override;

  // For ranks other than 0.
  std::string scratch_folder() const { return scratch_->path().string() + "/run"; }
  void note_failure(const std::string& why) { why_ = why; }

  // Waits for the other ranks; aborts all after a time limit. Returns the exit status.
  int leave(int status);

 private:
  void send_bytes(int to, const std::string& bytes) override;
  std::optional<std::pair<int, std::string>> receive_bytes() override;
  int leave_leading(int status);
  void leave_following(int status, bool stopped);

  const AsperityMpi* mpi_ = nullptr;
  std::unique_ptr<Team> team_;              // on first use
  std::optional<TemporaryFolder> scratch_;  // not on rank 0
  std::string why_;
};

}  // namespace asperity::cli
