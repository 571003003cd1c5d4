// SPDX-License-Identifier: GPL-3.0-or-later
// The processes of one run of one script. Rank 0 distributes cases, broadcasts rows, alone computes heavy
// calls outside ensembles, and can replace a failed rank. Call from the script's thread.
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
  // None waiting: nothing. Drops messages of lost ranks.
  std::optional<Message> receive();
  Message next();
  void put_back(Message message) { put_back_.push_front(std::move(message)); }

  // The run then fails at its end.
  void lose(int other, const std::string& why);
  bool lost(int other) const { return lost_.contains(other); }
  const std::vector<std::string>& losses() const { return losses_; }

  // Barrier before collective work (Team), with the same `what` on all ranks; `ensembles` counts those begun.
  // Throws Error{bad_state} on every waiting rank if one is missing or comes to other work.
  void meet(const std::string& what, int ensembles);
  virtual Team& team() = 0;

  // For cases; may be null. On other ranks the store of `--store`.
  ResultStore* own_store = nullptr;

 protected:
  virtual void send_bytes(int to, const std::string& bytes) = 0;
  virtual std::optional<std::pair<int, std::string>> receive_bytes() = 0;
  int rank_ = 0, size_ = 1;

 private:
  void call_together(const std::string& what, int ensembles);
  void wait_for_call(const std::string& what, int ensembles);

  std::deque<Message> put_back_;
  std::uint64_t meetings_ = 0;
  std::set<int> lost_;
  std::vector<std::string> losses_;
};

// Heavy calls outside ensembles: rank 0 loads or computes each result and sends it. If rank 0 fails, every
// rank tries.
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
