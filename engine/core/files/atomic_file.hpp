// SPDX-License-Identifier: GPL-3.0-or-later
// A file replaced atomically: written under a temporary name in the same folder, and renamed when it is
// whole. A reader sees the old file or the whole new one, never a torn one, and a failed write leaves what
// was there. Does not wait for the disk unless asked to: a power cut may lose the last moments, a kill does
// not.
//
// The temporary names are ".NAME.WRITER.part.EXTENSION", where WRITER is host and process as 8 and up to 10
// digits and 64 random bits, so that processes of several hosts and containers never write one file. A writer
// that is killed leaves its part behind; the name says whether it may still be written.
#pragma once

#include <filesystem>
#include <string_view>

namespace asperity {

// Whether the disk has the content before the name stands for it; the name itself is on the disk once the
// folder is (core/files/disk.hpp).
enum class Durable { no, yes };

// In whose words a file that cannot be written is refused: those of a run, which names `--out` where that
// helps, or those of readers and writers of data, which also say where the folder is missing or the name is
// one of a folder.
enum class FileWords { run, data };

// Not thread-safe; two objects of one target do not disturb each other, the last commit wins.
class AtomicFile {
 public:
  // Throws Error{bad_file} for a device or a pipe, in whose place the rename would put a file.
  explicit AtomicFile(std::filesystem::path target, FileWords words = FileWords::run);
  // Removes the temporary file unless commit() was called.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Where the bytes go before commit(), for writers that open files themselves.
  const std::filesystem::path& temporary() const { return temporary_; }
  // Appends bytes; the first call makes the file. Throws Error{bad_file} when they cannot be written.
  void write(std::string_view bytes, unsigned mode = 0666);
  // Puts the file in its place. Throws Error{bad_file}.
  void commit(Durable durable = Durable::no);

 private:
  int close();
  [[noreturn]] void refuse(int reason, bool renaming) const;

  std::filesystem::path target_, temporary_;
  FileWords words_;
  int descriptor_ = -1;
  bool committed_ = false;
};

// The whole content at once. Throws Error{bad_file} and leaves an earlier file as it was.
void write_atomically(const std::filesystem::path& target, std::string_view content,
                      Durable durable = Durable::no, unsigned mode = 0666);

// A file that has other names (hard links) is copied into its own place, so that what is written to it leaves
// them as they are. Any other file stays as it is. Throws Error{bad_file} where it cannot be copied.
void part_from_other_names(const std::filesystem::path& file);

// A name beside `target` that no other writer has, at most 255 bytes long. The extension stays last, because
// some writers choose their format by it.
std::filesystem::path part_beside(const std::filesystem::path& target);

// The name tells where its writer runs. A process that will be shut off from /proc finds that out before.
void find_own_place();

// Whether a file is a part by its name, of this version or of one before it.
bool is_part(const std::filesystem::path& file);

// Whether nobody can be writing this part: its process was of this host and has ended, or nothing has been
// written to the part for a day.
bool is_abandoned(const std::filesystem::path& part);

// Removes parts from a folder: those that are abandoned, or, where the caller knows that nobody else writes
// there, every one. Links are not followed. Folders inside are gone through as well if `deep`. What cannot be
// read or removed stays. Returns how many were removed.
enum class Parts { abandoned, all };
int sweep_parts(const std::filesystem::path& folder, Parts which, bool deep = false);

}  // namespace asperity
