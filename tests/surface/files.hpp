// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/stored_zip.hpp"

namespace asperity {

inline Surface read_surface(const std::string& path, const ReadOptions& options = {},
                            Monitor& monitor = Monitor::silent()) {
  return read_surface(SourceFile(path, monitor), options, monitor);
}
inline Profile read_profile(const std::string& path, const ReadProfileOptions& options = {},
                            Monitor& monitor = Monitor::silent()) {
  return read_profile(SourceFile(path, monitor), options, monitor);
}

}  // namespace asperity

namespace asperity::testing {

class Scratch {
 public:
  Scratch() {
    std::string pattern = (std::filesystem::temp_directory_path() / "asperity-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no scratch directory");
    directory_ = pattern;
  }
  ~Scratch() { std::filesystem::remove_all(directory_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(directory_), {}));
  }

 private:
  std::filesystem::path directory_;
};

inline std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::string sample(const std::string& name) {
  return std::string(ASPERITY_TEST_DATA) + "/../data/" + name;
}

// Path below ASPERITY_MEASURED; empty if unset.
inline std::string measured(const std::string& name) {
  const char* const directory = std::getenv("ASPERITY_MEASURED");
  return directory == nullptr || *directory == '\0' ? std::string() : std::string(directory) + "/" + name;
}

template <class Call>
std::optional<Error> error_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  return {};
}

template <class Call>
std::string message_of(Call&& call) {
  const std::optional<Error> error = error_of(call);
  return error ? std::string(error->what()) : "no error";
}

template <class T>
std::string raw(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// Passes truncated copies, and copies with flipped bits keyed by `seed`, to `attempt`, which must return or
// throw Error.
template <class Attempt>
void damage(const std::string& whole, std::uint64_t seed, int flips, Attempt&& attempt) {
  const auto harmless = [&](const std::string& bytes, const std::string& what) {
    try {
      attempt(bytes);
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ErrorCode::internal) << what << ": " << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << what << " gave " << error.what();
    }
  };
  const std::size_t step = whole.size() / 64 + 1;
  for (std::size_t length = 0; length < whole.size(); length += step)
    harmless(whole.substr(0, length), "cut at " + std::to_string(length));
  const Stream stream(seed, "damage");
  for (int k = 0; k < flips; ++k) {
    std::string bytes = whole;
    const auto key = static_cast<std::uint64_t>(k) * 8;
    const std::uint64_t changes = 1 + stream.below(key, 3);
    for (std::uint64_t c = 0; c < changes; ++c)
      bytes[stream.below(key + 1 + 2 * c, bytes.size())] =
          static_cast<char>(stream.below(key + 2 + 2 * c, 256));
    harmless(bytes, "flip " + std::to_string(k));
  }
}

}  // namespace asperity::testing
