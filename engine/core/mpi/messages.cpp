// SPDX-License-Identifier: GPL-3.0-or-later
// A message is its length, then pieces within MPI's int count. Sends are buffered against deadlock.
#include "engine/core/mpi/messages.hpp"

#include <dlfcn.h>
#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <string>
#include <vector>

namespace {

constexpr int length_tag = 1, piece_tag = 2;
constexpr std::uint64_t most = std::uint64_t{1} << 30;

struct Sending {
  std::uint64_t length = 0;
  std::string bytes;
  std::vector<MPI_Request> requests;
};
std::list<Sending>& sendings() {
  static std::list<Sending> list;
  return list;
}

void forget_what_arrived() {
  sendings().remove_if([](Sending& sending) {
    int done = 0;
    MPI_Testall(static_cast<int>(sending.requests.size()), sending.requests.data(), &done,
                MPI_STATUSES_IGNORE);
    return done != 0;
  });
}

int open_all(int* rank, int* size, char* reason, std::size_t room) {
  // MPI's plug-ins look up their symbols globally.
  ::dlopen("libmpi.so.40", RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
  int provided = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS ||
      provided < MPI_THREAD_FUNNELED) {
    std::snprintf(reason, room, "MPI could not be started with threads");
    return 1;
  }
  MPI_Comm_rank(MPI_COMM_WORLD, rank);
  MPI_Comm_size(MPI_COMM_WORLD, size);
  return 0;
}

void send(int to, const char* bytes, std::uint64_t length) {
  forget_what_arrived();
  Sending& sending = sendings().emplace_back();
  sending.length = length;
  sending.bytes.assign(bytes, length);
  const auto begin = [&](const void* from, int count, MPI_Datatype type, int tag) {
    MPI_Isend(from, count, type, to, tag, MPI_COMM_WORLD, &sending.requests.emplace_back());
  };
  begin(&sending.length, 1, MPI_UINT64_T, length_tag);
  for (std::uint64_t at = 0; at < length; at += most)
    begin(sending.bytes.data() + at, static_cast<int>(std::min(most, length - at)), MPI_BYTE, piece_tag);
}

int receive(int* from, char** bytes, std::uint64_t* length) {
  forget_what_arrived();
  int waits = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, length_tag, MPI_COMM_WORLD, &waits, &status);
  if (waits == 0) return 0;
  *from = status.MPI_SOURCE;
  MPI_Recv(length, 1, MPI_UINT64_T, *from, length_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  *bytes = static_cast<char*>(std::malloc(std::max<std::size_t>(*length, 1)));
  if (*bytes == nullptr) MPI_Abort(MPI_COMM_WORLD, 1);
  for (std::uint64_t at = 0; at < *length; at += most)
    MPI_Recv(*bytes + at, static_cast<int>(std::min(most, *length - at)), MPI_BYTE, *from, piece_tag,
             MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return 1;
}

void close_all() {
  for (Sending& sending : sendings())
    MPI_Waitall(static_cast<int>(sending.requests.size()), sending.requests.data(), MPI_STATUSES_IGNORE);
  sendings().clear();
  MPI_Finalize();
}

void abort_all(int status) { MPI_Abort(MPI_COMM_WORLD, status); }

}  // namespace

extern "C" const AsperityMpi* asperity_mpi_1() {
  static const AsperityMpi table{open_all, send, receive, close_all, abort_all};
  return &table;
}
