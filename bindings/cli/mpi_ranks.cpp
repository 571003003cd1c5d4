// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/mpi_ranks.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <thread>
#include <utility>

#include "bindings/cli/watchdog.hpp"
#include "engine/core/files/byte_string.hpp"
#include "engine/core/loaded_part.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/mpi/messages.hpp"
#include "engine/core/require.hpp"
#include "engine/core/slabs/team.hpp"

namespace asperity::cli {

namespace {

using Clock = std::chrono::steady_clock;
constexpr LoadedPart part{"mpi", "cases are spread over the ranks of mpirun", "libopenmpi3"};
// How long rank 0 waits for the other ranks at its end.
constexpr auto patience_done = std::chrono::seconds(60), patience_failed = std::chrono::seconds(3);

// In the environment.
std::optional<int> whole(const char* name) {
  const char* const given = std::getenv(name);
  const std::string text = given == nullptr ? "" : given;
  if (text.empty() || text.size() > 8 || text.find_first_not_of("0123456789") != std::string::npos) return {};
  return std::stoi(text);
}

// For `srun -n 3`. Only srun sets the step's number of tasks, and only PMIx the rank; a batch script, one
// process, has SLURM_NTASKS.
std::optional<LaunchedRank> started_by_srun(bool share) {
  const auto rank = whole("PMIX_RANK");
  const auto tasks = whole(rank ? "SLURM_NTASKS" : "SLURM_STEP_NUM_TASKS");
  const auto task = rank ? rank : whole("SLURM_PROCID");
  if (share || !tasks || !task || *tasks < 2) return {};
  if (!rank || std::getenv("PMIX_NAMESPACE") == nullptr)
    refuse(
        "srun started " + std::to_string(*tasks) + " tasks without MPI, and each would run the whole script",
        "use srun --mpi=pmix or mpirun; for separate runs give each --shard i/n, or start it by "
        "env -u PMIX_RANK -u SLURM_STEP_NUM_TASKS");
  return LaunchedRank{*task, *tasks, std::max(1, whole("SLURM_TASKS_PER_NODE").value_or(1))};
}

}  // namespace

std::optional<LaunchedRank> launched_rank(bool share) {
  using Names = std::array<const char*, 3>;
  for (const Names& names :
       {Names{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_LOCAL_SIZE"},
        Names{"PMI_SIZE", "PMI_RANK", "MPI_LOCALNRANKS"}}) {
    const auto size = whole(names[0]), rank = whole(names[1]);
    if (!size || !rank) continue;
    if (*size < 2) return {};
    return LaunchedRank{*rank, *size, std::max(1, whole(names[2]).value_or(1))};
  }
  return started_by_srun(share);
}

int threads_of(const LaunchedRank& launched) {
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  cpu_set_t allowed;
  const int bound = sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : processors;
  return std::max(1, std::min(bound, processors / launched.on_this_machine));
}

MpiRanks::MpiRanks(int started) {
  const auto table = part_function<AsperityMpiTable>(part, "asperity_mpi_1");
  mpi_ = table();
  pthread_sigmask(SIG_BLOCK, &stop_signals(), nullptr);
  std::array<char, 512> reason{};
  if (mpi_->open(&rank_, &size_, reason.data(), reason.size()) != 0) refuse_bad_file(reason.data());
  if (size_ < started)
    refuse(std::to_string(started) + " processes were started, and MPI joins " + std::to_string(size_) +
               " of them",
           "start them by srun --mpi=pmix or by the mpirun of Open MPI");
  if (leads()) return;
  scratch_.emplace("rank");
  // Only rank 0 prints.
  std::fflush(nullptr);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

Team& MpiRanks::team() {
  if (!team_) team_ = team_of_mpi(part, rank_, size_);
  return *team_;
}

void MpiRanks::send_bytes(int to, const std::string& bytes) { mpi_->send(to, bytes.data(), bytes.size()); }

std::optional<std::pair<int, std::string>> MpiRanks::receive_bytes() {
  int from = 0;
  char* bytes = nullptr;
  std::uint64_t length = 0;
  if (mpi_->receive(&from, &bytes, &length) == 0) return {};
  const std::unique_ptr<char, void (*)(void*)> held(bytes, std::free);
  return std::pair(from, std::string(bytes, static_cast<std::size_t>(length)));
}

int MpiRanks::leave(int status) {
  std::fflush(nullptr);
  const bool stopped = stop_flag().reason() != StopReason::none;
  if (leads()) {
    // Too late for a stop.
    if (stopped && status != 0) mpi_->abort(status);
    return leave_leading(status);
  }
  leave_following(status, stopped);
  return 0;
}

int MpiRanks::leave_leading(int status) {
  send_to_others(Kind::end, "");
  const auto begun = Clock::now();
  std::set<int> ended;
  const auto patience = status == 0 ? patience_done : patience_failed;
  while (static_cast<int>(ended.size()) < size_ - 1) {
    if (const auto found = receive_bytes()) {
      if (found->second.empty() || found->second[0] != static_cast<char>(Kind::end)) continue;
      ended.insert(found->first);
      ByteReader in(std::string_view(found->second).substr(1));
      const std::string why = in.text();
      if (!why.empty() && status == 0) lose(found->first, "failed: " + why);
      continue;
    }
    for (int other = 1; other < size_; ++other)
      if (lost(other)) ended.insert(other);
    if (Clock::now() - begun > patience) {
      std::fprintf(stderr,
                   "asperity: rank 0 has ended, and %d of the other ranks have not: they are stopped\n",
                   size_ - 1 - static_cast<int>(ended.size()));
      mpi_->abort(status == 0 ? 1 : status);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  for (const std::string& loss : losses()) std::fprintf(stderr, "asperity: %s\n", loss.c_str());
  if (!losses().empty()) {
    if (status == 0) status = 1;
    // A rank on another path may never end.
    std::fflush(nullptr);
    mpi_->abort(status);
  }
  mpi_->close();
  return status;
}

// After a stop, rank 0 ends all ranks once its record is safe.
void MpiRanks::leave_following(int status, bool stopped) {
  const auto end = [this](const std::string& why) {
    ByteWriter out;
    out.text(why);
    send(0, Kind::end, out.take());
  };
  if (!stopped) end(status != 0 && why_.empty() ? "it ended with status " + std::to_string(status) : why_);
  const auto begun = Clock::now();
  for (;;) {
    const std::optional<Message> message = receive();
    if (message && message->kind == Kind::end) break;
    if (stopped && Clock::now() - begun > patience_failed) {
      scratch_.reset();
      mpi_->abort(status);
    }
    if (!message) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (stopped) end("");
  scratch_.reset();
  mpi_->close();
}

}  // namespace asperity::cli
