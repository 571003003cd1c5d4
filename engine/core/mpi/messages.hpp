// SPDX-License-Identifier: GPL-3.0-or-later
// What asperity-mpi.so offers the program: messages of bytes between the processes that mpirun started. Every
// call is made from one thread. Plain C, so that it crosses the border of a part that is loaded late.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

struct AsperityMpi {
  // Joins the others. 0, or else why not in `reason`.
  int (*open)(int* rank, int* size, char* reason, std::size_t room);
  // Takes a copy and returns at once. Messages of one sender arrive in their order.
  void (*send)(int to, const char* bytes, std::uint64_t length);
  // 1 with a message, whose bytes are to be given to free(); 0 where none waits.
  int (*receive)(int* from, char** bytes, std::uint64_t* length);
  // Waits until what was sent has arrived, and leaves. All processes must come here.
  void (*close)();
  // Ends every process, this one too.
  void (*abort)(int status);
};

using AsperityMpiTable = const AsperityMpi*();
__attribute__((visibility("default"))) const AsperityMpi* asperity_mpi_1();
}
