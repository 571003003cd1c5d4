// SPDX-License-Identifier: GPL-3.0-or-later
// The processes of one run, which run the same script side by side. Rank 0 owns the run: it hands out the
// cases of ensembles, collects what they find and gives all rows to all; and it alone computes heavy calls
// outside ensembles, whose results the others wait for. Whatever happens to another rank, rank 0 can finish
// what is missing itself. All calls are made from the thread that runs the script.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/core/files/result_store.hpp"
#include "engine/core/slabs/team.hpp"

namespace asperity {

class Ranks {
 public:
  enum class Kind : std::uint8_t { hello, result, cases, rows, kept, end, here, go };
  struct Message {
    int from = 0;
    Kind kind = Kind::end;
    std::string bytes;
  };

  virtual ~Ranks() = default;
  int rank() const { return rank_; }
  int size() const { return size_; }
  bool leads() const { return rank_ == 0; }

  void send(int to, Kind kind, const std::string& bytes);
  void send_to_others(Kind kind, const std::string& bytes);
  // The next message of the others; none where none waits. Messages of lost ranks are dropped.
  std::optional<Message> receive();
  // To be received again, before all others.
  void put_back(Message message) { put_back_.push_front(std::move(message)); }

  // For rank 0: another one is not counted on any more, and why, which makes the run fail at its end.
  void lose(int other, const std::string& why);
  bool lost(int other) const { return lost_.contains(other); }
  const std::vector<std::string>& losses() const { return losses_; }

  // Before work that all processes do together (Team): waits until each has come to it. `what` names it, the
  // same in all; `ensembles` is how many the script has begun. Throws Error{bad_state} in every process that
  // comes where one does not, or comes to something else.
  void meet(const std::string& what, int ensembles);
  // For that work.
  virtual Team& team() = 0;

  // The run's own store, for cases; null where there is none. On ranks other than 0 that of `--store`.
  ResultStore* own_store = nullptr;

 protected:
  virtual void send_bytes(int to, const std::string& bytes) = 0;
  virtual std::optional<std::pair<int, std::string>> receive_bytes() = 0;
  int rank_ = 0, size_ = 1;

 private:
  void call_together(const std::string& what, int ensembles);
  void wait_for_call(const std::string& what, int ensembles);
  Message next();

  std::deque<Message> put_back_;
  std::uint64_t meetings_ = 0;
  std::set<int> lost_;
  std::vector<std::string> losses_;
};

// The results of heavy calls outside ensembles: rank 0 takes them from its store or computes them, and sends
// them to the others, which wait. One that rank 0 could not compute is tried by all.
class RankStore final : public ResultStore {
 public:
  explicit RankStore(Ranks& ranks) : ranks_(ranks) {}
  std::optional<FoundResult> find(const std::string& key) override;
  void keep(const std::string& key, std::string_view call, const ResultFacts& facts,
            const KeptFields& fields) override;

 private:
  Ranks& ranks_;
};

}  // namespace asperity
