// SPDX-License-Identifier: GPL-3.0-or-later
// The lock of a run directory: of all processes that would write there one does. It is a lock of an open file
// description on the file `.lock`, which the system gives back when the process ends, however it ends; the
// file stays and names process and host of its last holder. Where the file system gives no locks the name in
// the file decides: a holder of this host that has ended is passed over, one of another host is believed to
// live. Readers of a run take no lock.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace asperity {

class RunLock {
 public:
  static constexpr const char* file_name = ".lock";
  // Asks the system for the lock of an open file without waiting; 0 or the error number. Another one in
  // tests.
  using Ask = std::function<int(int descriptor)>;
  static int ask_system(int descriptor);

  // Locks a folder that exists. Throws Error{bad_state} naming process and host where another one holds the
  // lock, having changed nothing; Error{bad_file} where `.lock` cannot be opened or is a link.
  static std::shared_ptr<RunLock> take(const std::filesystem::path& folder, const Ask& ask = ask_system);
  // As take() where the folder has been locked before; null where it has no `.lock`, which is not made.
  static std::shared_ptr<RunLock> take_if_known(const std::filesystem::path& folder);
  // The lock of a parent that gave this process its open file: the folder is held until both have ended or
  // released it, under the parent's name, which release() leaves there.
  static std::shared_ptr<RunLock> inherited(const std::filesystem::path& folder, int descriptor);

  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  // Gives the folder free before the end of the process.
  void release();

  // The open file, for a child that is to inherit the lock; -1 once released.
  int descriptor() const { return descriptor_; }

  // A sentence where the file system gives no locks; "" otherwise.
  const std::string& notice() const { return notice_; }

 private:
  RunLock(std::filesystem::path folder, int descriptor);
  static std::shared_ptr<RunLock> open(const std::filesystem::path& folder, int flags, const Ask& ask);
  int ask_patiently(const Ask& ask);
  bool is_of_this_folder_alone();
  void hold_by_name();
  void write_name();

  std::filesystem::path folder_;
  std::string notice_;
  int descriptor_ = -1;
  bool inherited_ = false;
};

}  // namespace asperity
