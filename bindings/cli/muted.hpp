// SPDX-License-Identifier: GPL-3.0-or-later
// Discards standard output during its lifetime: a repeated script has already printed.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace asperity::cli {

class Muted {
 public:
  Muted() {
    std::fflush(stdout);
    kept_ = ::dup(STDOUT_FILENO);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
    if (nowhere >= 0) ::close(nowhere);
  }
  ~Muted() {
    std::fflush(stdout);
    if (kept_ < 0) return;
    ::dup2(kept_, STDOUT_FILENO);
    ::close(kept_);
  }
  Muted(const Muted&) = delete;
  Muted& operator=(const Muted&) = delete;

 private:
  int kept_ = -1;
};

}  // namespace asperity::cli
