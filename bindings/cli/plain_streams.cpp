// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/cli/plain_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <string>

#include "engine/core/files/disk.hpp"
#include "engine/core/text.hpp"

namespace asperity::cli {

namespace {

struct PlainStream {
  int descriptor;
  Keeps keeps;
  std::string tail{};  // incomplete character or sequence
};

// Leading "ESC [ 1 ; 31 m"; 0 for other text, npos if incomplete.
std::size_t colour_sequence(std::string_view text) {
  constexpr std::size_t longest = 32;
  for (std::size_t k = 0; k < std::min(text.size(), longest); ++k) {
    const char c = text[k];
    if (k == 0 ? c != '\033' : k == 1 && c != '[') return 0;
    if (k > 1 && c == 'm') return k + 1;
    if (k > 1 && c != ';' && std::isdigit(static_cast<unsigned char>(c)) == 0) return 0;
  }
  return text.size() < longest ? std::string_view::npos : 0;
}

// Removes and returns the complete part.
std::string shown_part(std::string& text, Keeps keeps) {
  std::string shown;
  std::size_t begin = 0;
  const auto put_plain = [&](std::size_t end) {
    shown += plain_text(text.substr(begin, end - begin));
    begin = end;
  };
  if (keeps == Keeps::colours)
    for (std::size_t at = 0; (at = text.find_first_of("\033\r", std::max(at, begin))) != std::string::npos;) {
      const std::size_t kept = text[at] == '\r' ? 1 : colour_sequence(std::string_view(text).substr(at));
      if (kept == 0) {
        ++at;
        continue;
      }
      put_plain(at);
      if (kept == std::string_view::npos) {
        text.erase(0, begin);
        return shown;
      }
      shown.append(text, begin, kept);
      begin += kept;
    }
  put_plain(text.size() - std::min(unfinished_bytes(text), text.size() - begin));
  text.erase(0, begin);
  return shown;
}

ssize_t write_plain(void* cookie, const char* bytes, std::size_t count) {
  auto& stream = *static_cast<PlainStream*>(cookie);
  stream.tail.append(bytes, count);
  if (write_all(stream.descriptor, shown_part(stream.tail, stream.keeps)) == 0)
    return static_cast<ssize_t>(count);
  stream.tail.clear();
  return 0;
}

// Null if out of memory.
FILE* plain_stream(int descriptor, Keeps keeps) {
  // Never freed: C streams flush after all destructors.
  static std::array<PlainStream*, STDERR_FILENO + 1> kept{};
  PlainStream*& stream = kept.at(static_cast<std::size_t>(descriptor));
  if (stream == nullptr) stream = new PlainStream{descriptor, keeps};
  return ::fopencookie(stream, "w",
                       {.read = nullptr, .write = write_plain, .seek = nullptr, .close = nullptr});
}

#if defined(__EMSCRIPTEN__)
void replace(FILE*, FILE*) {}  // musl's streams are constant: text passes unchanged
#else
void replace(FILE*& stream, FILE* made) { stream = made; }
#endif

}  // namespace

void make_errors_plain() {
  FILE* const made = plain_stream(STDERR_FILENO, Keeps::text);
  if (made == nullptr) return;
  std::setvbuf(made, nullptr, _IONBF, 0);
  replace(stderr, made);
}

void make_output_plain(Keeps keeps) {
  FILE* const made = plain_stream(STDOUT_FILENO, keeps);
  if (made == nullptr) return;
  std::fflush(stdout);
  if (::isatty(STDOUT_FILENO) != 0) std::setvbuf(made, nullptr, _IOLBF, BUFSIZ);
  replace(stdout, made);
}

void erase_shown_line() {
  std::fflush(stderr);
  write_all(STDERR_FILENO, erase_line);
}

Muted::Muted() {
  std::fflush(stdout);
  kept_ = ::dup(STDOUT_FILENO);
  const ScopedFile nowhere(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  if (kept_ >= 0 && nowhere.number >= 0) ::dup2(nowhere.number, STDOUT_FILENO);
}

Muted::~Muted() {
  std::fflush(stdout);
  if (kept_ < 0) return;
  ::dup2(kept_, STDOUT_FILENO);
  ::close(kept_);
}

}  // namespace asperity::cli
