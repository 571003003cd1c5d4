// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/slabs/team.hpp"

#include <cstring>

#include "engine/core/monitor.hpp"

namespace asperity {

namespace {

// Appended to every sum: failure and reason to stop.
constexpr std::size_t marks = 2;
constexpr std::size_t text_room = 2000;

class TeamOfOne final : public Team {
 public:
  std::unique_ptr<SlabFourier> fourier(int nx, int ny) override {
    std::unique_ptr<SlabFourier> made;
    work([&] { made = fourier_alone(nx, ny); });
    agree();
    return made;
  }
  void exchange(const double* out, const int* out_counts, double* in, const int*) override {
    std::copy_n(out, out_counts[0], in);
  }

 private:
  void gather_bytes(const void* own, std::size_t bytes, void* all) override { std::memcpy(all, own, bytes); }
};

struct Report {
  int code;
  char sentence[text_room], hint[text_room];
};

void put(const std::string& text, char* to) {
  const std::size_t length = std::min(text.size(), text_room - 1);
  std::memcpy(to, text.data(), length);
  to[length] = '\0';
}

}  // namespace

Team& Team::alone() {
  static thread_local TeamOfOne team;
  return team;
}

void Team::reduce(std::span<const double> own, std::size_t sums, std::span<double> total) {
  const std::size_t n = own.size(), stride = n + marks;
  // No allocation, which could fail in one process alone.
  constexpr std::size_t most = 64, most_together = 16384;
  std::array<double, most> packed{};
  std::array<double, most_together> together;
  if (stride > most || stride * static_cast<std::size_t>(size_) > most_together)
    throw Error(ErrorCode::internal, "more numbers are added over processes than there is room for");
  std::ranges::copy(own, packed.begin());
  packed[n] = failure_ ? 1 : 0;
  packed[n + 1] = static_cast<double>(static_cast<int>(stop_flag().reason()));
  gather_bytes(packed.data(), stride * sizeof(double), together.data());
  for (int r = 0; r < size_; ++r) {
    const double* const from = together.data() + static_cast<std::size_t>(r) * stride;
    if (from[n] != 0 || from[n + 1] != 0) throw_what_happened(together.data() + n, stride);
    for (std::size_t i = 0; i < n; ++i)
      total[i] = r == 0 ? from[i] : i < sums ? total[i] + from[i] : std::min(total[i], from[i]);
  }
}

Array<double> Team::gather(std::span<const double> own) {
  Array<double> all;
  work([&] { all.resize(own.size() * static_cast<std::size_t>(size_)); });
  agree();
  gather_bytes(own.data(), own.size_bytes(), all.data());
  return all;
}

std::string Team::text_of_first(const std::string& own) {
  if (size_ == 1) return own;
  const auto length =
      static_cast<std::size_t>(reduce<1>({rank_ == 0 ? static_cast<double>(own.size()) : 0.0})[0]);
  std::string mine, all;
  work([&] {
    if (rank_ == 0) mine = own;
    mine.resize(length);
    all.resize(length * static_cast<std::size_t>(size_));
  });
  agree();
  gather_bytes(mine.data(), length, all.data());
  return all.substr(0, length);
}

void Team::throw_what_happened(const double* happened, std::size_t stride) {
  const std::optional<Error> own = std::exchange(failure_, std::nullopt);
  int reason = 0, failed = -1;
  for (int r = size_ - 1; r >= 0; --r) {
    const double* const at = happened + static_cast<std::size_t>(r) * stride;
    if (at[1] != 0) reason = static_cast<int>(at[1]);
    if (at[0] != 0) failed = r;
  }
  if (reason != 0) {
    stop_flag().raise(static_cast<StopReason>(reason));
    stop_flag().check();
  }
  if (size_ == 1) throw Error(*own);
  static Report report;  // used by one thread; needs no allocation
  report.code = own ? static_cast<int>(own->code()) : 0;
  put(own ? own->sentence() : "", report.sentence);
  put(own ? own->hint() : "", report.hint);
  static std::array<char, sizeof(Report) * 256> reports;
  if (size_ > 256) throw Error(ErrorCode::internal, "rank " + std::to_string(failed) + " failed");
  gather_bytes(&report, sizeof report, reports.data());
  Report first;
  std::memcpy(&first, reports.data() + static_cast<std::size_t>(failed) * sizeof(Report), sizeof first);
  throw Error(static_cast<ErrorCode>(first.code),
              std::string(first.sentence) + " (in rank " + std::to_string(failed) + " of " +
                  std::to_string(size_) + ")",
              first.hint);
}

}  // namespace asperity
