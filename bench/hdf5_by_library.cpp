// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 files by the HDF5 library in a limited child process (shared memory for the numbers), against the
// reader of this project: corrupted files, and maps from disk and memory.
//
//   bench_hdf5_by_library changed FIRST COUNT tests/fuzz/corpus/hdf5/*.h5
//   bench_hdf5_by_library maps 4 1024 4096
#include <hdf5.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"

namespace {

using namespace asperity;
constexpr int answer = 3;  // descriptor of the child
const std::string aside = "/dev/shm/asperity-bench-" + std::to_string(::getpid()) + ".h5";

// Reads numbers as doubles; skips references to other files.
herr_t take(hid_t root, const char* name, const H5O_info_t* info, void* taken) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hid_t data = H5Dopen2(root, name, H5P_DEFAULT);
  if (data < 0) return -1;
  const hid_t made = H5Dget_create_plist(data);
  const H5T_class_t kind = H5Tget_class(H5Dget_type(data));
  const bool elsewhere = H5Pget_layout(made) == H5D_VIRTUAL || H5Pget_external_count(made) > 0;
  const hssize_t count = H5Sget_simple_extent_npoints(H5Dget_space(data));
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || elsewhere || count <= 0) return 0;
  const std::size_t bytes = static_cast<std::size_t>(count) * sizeof(double);
  auto& start = *static_cast<off_t*>(taken);
  if (::ftruncate(answer, start + static_cast<off_t>(bytes)) != 0) return -1;
  void* const to = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, answer, start);
  start += static_cast<off_t>((bytes + 4095) / 4096 * 4096);
  return to == MAP_FAILED ? -1 : H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to);
}

void read_as_child(const char* path) {
  const rlim_t size = std::filesystem::file_size(path), seconds = 2 + size / 20'000'000;
  const rlimit processor{seconds, seconds}, memory{(1 << 29) + 4 * size, (1 << 29) + 4 * size};
  ::setrlimit(RLIMIT_CPU, &processor);
  ::setrlimit(RLIMIT_AS, &memory);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  off_t start = 0;
  ::_exit(file < 0 || H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, take, &start) < 0 ? 1 : 0);
}

// Describes the end of the child.
std::string read_by_child(std::string path) {
  const int memory = ::memfd_create("numbers", MFD_CLOEXEC);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, memory, answer);
  char program[] = "/proc/self/exe", word[] = "child";
  char* const arguments[] = {program, word, path.data(), nullptr};
  pid_t child = 0;
  if (::posix_spawn(&child, program, &actions, nullptr, arguments, environ) != 0) std::abort();
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  ::waitpid(child, &status, 0);
  const auto bytes = static_cast<std::size_t>(::lseek(memory, 0, SEEK_END));
  if (status == 0 && bytes >= sizeof(double)) {
    Array<double> numbers(bytes / sizeof(double));
    if (::pread(memory, numbers.data(), bytes, 0) < 0) std::abort();
  }
  ::close(memory);
  if (WIFSIGNALED(status)) return std::string("died: ") + ::strsignal(WTERMSIG(status));
  return status != 0 ? "refused" : bytes > 0 ? "answered with numbers" : "answered";
}

double seconds_of(auto&& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void tell(const std::string& of, std::vector<double> seconds) {
  std::ranges::sort(seconds);
  const std::size_t n = seconds.size();
  std::printf("%s: median %.2f ms, 95 %% below %.2f, longest %.2f\n", of.c_str(), 1e3 * seconds[n / 2],
              1e3 * seconds[n * 95 / 100], 1e3 * seconds.back());
}

void changed(std::uint64_t first, std::uint64_t count, char** paths, std::uint64_t path_count) {
  std::map<std::string, int> ends;
  std::vector<double> times;
  for (std::uint64_t k = first; k < first + count; ++k) {
    std::string bytes(SourceFile(paths[k % path_count], Monitor::silent()).bytes());
    const Stream stream(k, "changed");
    for (std::uint64_t c = 0; c <= stream.below(0, 6); ++c)
      bytes[stream.below(2 * c + 1, bytes.size())] = static_cast<char>(stream.below(2 * c + 2, 256));
    if (k % 5 == 0) bytes.resize(1 + stream.below(99, bytes.size()));
    std::ofstream(aside) << bytes;
    std::string end;
    times.push_back(seconds_of([&] { ++ends[end = read_by_child(aside)]; }));
    try {
      read_hdf5(aside);
    } catch (const Error&) {
      ++ends[end + ", where this project's reader refuses"];
    }
  }
  for (const auto& [end, how_many] : ends) std::printf("%6d %s\n", how_many, end.c_str());
  tell("child", times);
}

void time_map(std::size_t n) {
  const std::string file = aside + ".map";
  write_hdf5(file, {{}, {owning_array<double>("height", {n, n}, Array<double>(n * n, 1e-6))}});
  std::vector<double> ours, path, memory;
  for (int k = 0; k < (n > 2000 ? 10 : 50); ++k) {
    ours.push_back(seconds_of([&] { read_hdf5(file); }));
    path.push_back(seconds_of([&] { read_by_child(file); }));
    memory.push_back(seconds_of([&] {
      std::ofstream(aside) << SourceFile(file, Monitor::silent()).bytes();
      read_by_child(aside);
    }));
    for (auto* more : {&path, &memory}) more->back() -= ours.back();
  }
  tell("ours, " + std::to_string(n) + " squared", ours);
  tell("child, more by", path);
  tell("child from memory, more by", memory);
  std::filesystem::remove(file);
}

}  // namespace

int main(int count, char** words) {
  const std::string what = count > 2 ? words[1] : "";
  if (what == "child") read_as_child(words[2]);
  if (what == "changed") changed(std::stoull(words[2]), std::stoull(words[3]), words + 4, count - 4);
  for (int k = 2; what == "maps" && k < count; ++k) time_map(std::stoull(words[k]));
  std::filesystem::remove(aside);
}
