// SPDX-License-Identifier: GPL-3.0-or-later
// The lock of a run directory for one writing process: an open file description lock on `.lock`, released by
// the system at any end of the process. The file names process and host of the last holder. On file systems
// without locks this name is the lock: an ended holder on this host is ignored, one on another host counts as
// alive. Readers take none.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace asperity {

class RunLock {
 public:
  static constexpr const char* file_name = ".lock";
  // Requests the lock without waiting; 0 or the error number.
  using Ask = std::function<int(int descriptor)>;
  static int ask_system(int descriptor);

  // Throws Error{bad_state} with process and host of another holder; Error{bad_file} if `.lock` is
  // inaccessible or a link.
  static std::shared_ptr<RunLock> take(const std::filesystem::path& folder, const Ask& ask = ask_system);
  // Null without `.lock`, which is not created.
  static std::shared_ptr<RunLock> take_if_known(const std::filesystem::path& folder);
  // From a parent with its open file: locked, under the parent's name, until both have released it.
  static std::shared_ptr<RunLock> inherited(const std::filesystem::path& folder, int descriptor);

  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  void release();

  // For a child; -1 once released.
  int descriptor() const { return descriptor_; }

  // A sentence if the file system has no locks; else "".
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
