// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/sandbox/frames.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "engine/core/error.hpp"
#include "engine/core/files/disk.hpp"

namespace asperity::web {

namespace {

constexpr std::uint64_t most_texts = 64;

void put_number(std::string& to, std::uint64_t number) {
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  to.append(bytes, sizeof number);
}

bool get_number(int descriptor, std::uint64_t& number) {
  return read_whole(descriptor, reinterpret_cast<char*>(&number), sizeof number);
}

}  // namespace

bool read_whole(int descriptor, char* to, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t got = ::read(descriptor, to, bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    bytes -= static_cast<std::size_t>(got);
  }
  return true;
}

std::string frame(std::span<const std::string_view> texts) {
  std::size_t size = sizeof(std::uint64_t);
  for (const std::string_view text : texts) size += sizeof(std::uint64_t) + text.size();
  std::string bytes;
  bytes.reserve(size);
  put_number(bytes, texts.size());
  for (const std::string_view text : texts) {
    put_number(bytes, text.size());
    bytes += text;
  }
  return bytes;
}

bool send_frame(int descriptor, std::span<const std::string_view> texts) {
  return write_all(descriptor, frame(texts)) == 0;
}

std::optional<std::vector<std::string>> receive_frame(int descriptor, std::size_t most_bytes) {
  std::uint64_t count = 0;
  if (!get_number(descriptor, count) || count > most_texts) return {};
  std::vector<std::string> texts;
  for (std::uint64_t k = 0; k < count; ++k) {
    std::uint64_t bytes = 0;
    if (!get_number(descriptor, bytes) || bytes > most_bytes) return {};
    most_bytes -= static_cast<std::size_t>(bytes);
    std::string& text = texts.emplace_back();
    // A claimed length must not allocate memory.
    while (text.size() < bytes) {
      const std::size_t had = text.size();
      text.resize(had + std::min<std::uint64_t>(bytes - had, std::uint64_t{1} << 20));
      if (!read_whole(descriptor, text.data() + had, text.size() - had)) return {};
    }
  }
  return texts;
}

std::optional<std::vector<std::string>> take_frame(std::string& arrived, std::size_t most_bytes) {
  std::size_t at = 0;
  const auto number = [&]() -> std::optional<std::uint64_t> {
    std::uint64_t value = 0;
    if (arrived.size() - at < sizeof value) return {};
    std::memcpy(&value, arrived.data() + at, sizeof value);
    at += sizeof value;
    return value;
  };
  const auto count = number();
  if (!count) return {};
  if (*count > most_texts) refuse_bad_file("the received data are no frame");
  std::vector<std::string_view> found;
  for (std::uint64_t k = 0; k < *count; ++k) {
    const auto bytes = number();
    if (!bytes) return {};
    if (*bytes > most_bytes) refuse_bad_file("a frame is too long");
    most_bytes -= static_cast<std::size_t>(*bytes);
    if (arrived.size() - at < *bytes) return {};
    found.push_back(std::string_view(arrived).substr(at, static_cast<std::size_t>(*bytes)));
    at += static_cast<std::size_t>(*bytes);
  }
  std::vector<std::string> texts(found.begin(), found.end());
  arrived.erase(0, at);
  return texts;
}

}  // namespace asperity::web
