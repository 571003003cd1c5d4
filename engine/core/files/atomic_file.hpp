// SPDX-License-Identifier: GPL-3.0-or-later
// Atomic replacement of a file: written under a temporary name in the same folder, then renamed. By default
// without waiting for the disk: a power cut may lose the last moments, a kill does not.
//
// Temporary names are ".NAME.WRITER.part.EXTENSION". WRITER contains host, process and 64 random bits, so
// that hosts and containers never share a file, and others see whether the writer of a remaining part may
// still run.
#pragma once

#include <filesystem>
#include <string_view>

namespace asperity {

// Whether the content reaches the disk before the rename. For the name, see core/files/disk.hpp.
enum class Durable { no, yes };

// Wording of errors: `run` mentions `--out`.
enum class FileWords { run, data };

// Not thread-safe. Objects of one target are independent; the last commit wins.
class AtomicFile {
 public:
  // Throws Error{bad_file} for a device or pipe, which the rename would replace.
  explicit AtomicFile(std::filesystem::path target, FileWords words = FileWords::run);
  // Removes an uncommitted temporary file.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  // Appends; the first call creates the file. Throws Error{bad_file}.
  void write(std::string_view bytes, unsigned mode = 0666);
  // Throws Error{bad_file}.
  void commit(Durable durable = Durable::no);

 private:
  int close();
  [[noreturn]] void refuse(int reason, bool renaming) const;

  std::filesystem::path target_, temporary_;
  FileWords words_;
  int descriptor_ = -1;
  bool committed_ = false;
};

// On Error{bad_file}, an earlier file stays unchanged.
void write_atomically(const std::filesystem::path& target, std::string_view content,
                      Durable durable = Durable::no, unsigned mode = 0666);

// Replaces a file with several hard links by a copy. Throws Error{bad_file}.
void part_from_other_names(const std::filesystem::path& file);

// A unique temporary name, at most 255 bytes, with the same extension.
std::filesystem::path part_beside(const std::filesystem::path& target);

// Call before /proc, which identifies the host, is inaccessible.
void find_own_place();

// Also recognises names of earlier versions.
bool is_part(const std::filesystem::path& file);

// The writer ended on this host, or the part is unchanged for a day.
bool is_abandoned(const std::filesystem::path& part);

// Removes parts, without following links; recursive if `deep`. `all`: no other process may write there. Skips
// undeletable files. Returns the number removed.
enum class Parts { abandoned, all };
int sweep_parts(const std::filesystem::path& folder, Parts which, bool deep = false);

// A temporary folder, removed with its content by the destructor. Each new folder removes folders of killed
// writers from the same parent.
class TemporaryFolder {
 public:
  // Default `parent`: the system's temporary folder. Throws Error{bad_file}.
  explicit TemporaryFolder(std::string_view purpose, const std::filesystem::path& parent = {});
  ~TemporaryFolder() { remove(); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // For a process that ends without destructors.
  void remove() const;

 private:
  std::filesystem::path path_;
};

}  // namespace asperity
