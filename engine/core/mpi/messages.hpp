// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of asperity-mpi.so: byte messages between the processes of mpirun, from one thread each. Plain C,
// for late loading.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

struct AsperityMpi {
  // Returns 0, or nonzero with a `reason`.
  int (*open)(int* rank, int* size, char* reason, std::size_t room);
  // Copies the message and returns at once. Messages of one sender arrive in order.
  void (*send)(int to, const char* bytes, std::uint64_t length);
  // 1 with a message, which the caller passes to free(); 0 without.
  int (*receive)(int* from, char** bytes, std::uint64_t* length);
  // Waits for delivery of all sent messages, then leaves. Collective.
  void (*close)();
  void (*abort)(int status);
};

using AsperityMpiTable = const AsperityMpi*();
__attribute__((visibility("default"))) const AsperityMpi* asperity_mpi_1();
}
