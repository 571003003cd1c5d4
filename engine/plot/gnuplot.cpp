// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>
#include <utility>

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/require.hpp"

extern char** environ;

namespace asperity {

namespace fs = std::filesystem;

namespace {

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Without language, time zone (PDF date) and gnuplot's variables.
std::vector<char*> plain_environment() {
  static char language[] = "LC_ALL=C.UTF-8", zone[] = "TZ=UTC0";
  std::vector<char*> kept;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (!text.starts_with("LC_") && !text.starts_with("LANG") && !text.starts_with("GNUPLOT") &&
        !text.starts_with("GNUTERM") && !text.starts_with("TZ="))
      kept.push_back(*entry);
  }
  kept.insert(kept.end(), {language, zone});
  kept.push_back(nullptr);
  return kept;
}

pid_t start(const fs::path& folder) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "messages", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  // Own process group: Ctrl-C reaches only the run.
  sigset_t every, none;
  sigfillset(&every);
  sigemptyset(&none);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setsigdefault(&attributes, &every);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  char program[] = "gnuplot", settings[] = "-d", script[] = "script";
  std::array<char*, 4> arguments = {program, settings, script, nullptr};
  std::vector<char*> environment = plain_environment();
  pid_t child = 0;
  const int reason =
      posix_spawnp(&child, program, &actions, &attributes, arguments.data(), environment.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (reason == ENOENT || reason == EACCES)
    refuse_state("charts and pictures are drawn by gnuplot, which is not installed",
                 "install the package gnuplot-nox");
  if (reason != 0) refuse_state(std::string("gnuplot cannot be started: ") + std::strerror(reason));
  return child;
}

int wait_for(pid_t child) {
  using namespace std::chrono_literals;
  for (auto pause = 500us;; pause = std::min<std::chrono::microseconds>(2 * pause, 10ms)) {
    int status = 0;
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR)
      throw Error(ErrorCode::internal, std::string("gnuplot was lost: ") + std::strerror(errno));
    if (stop_flag().reason() != StopReason::none) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      stop_flag().check();
      return status;
    }
    std::this_thread::sleep_for(pause);
  }
}

std::string without_ends(std::string text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::function<GnuplotDrawer>& drawer() {
  static std::function<GnuplotDrawer> other;
  return other;
}

int left = 0;

}  // namespace

std::string gnuplot_text(std::string_view text) {
  constexpr int longest = 200;
  std::string literal = "'";
  int characters = 0;
  for (std::size_t k = 0; k < text.size();) {
    if (++characters > longest) {
      literal += "…";
      break;
    }
    const std::size_t length = utf8_bytes(std::string_view(text).substr(k));
    const auto byte = static_cast<unsigned char>(text[k]);
    if (length == 0) {
      literal += '?';
    } else if (byte < 0x20 || byte == 0x7F) {
      literal += ' ';
    } else if (byte == '\'') {
      literal += "’";  // a doubled quote fails at the start of a text
    } else {
      literal += text.substr(k, length);
    }
    k += length == 0 ? 1 : length;
  }
  return literal + "'";
}

std::string gnuplot_number(double value) { return format_exact(value); }

std::string gnuplot_colour(unsigned rgb) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "rgb '#%06x'", rgb & 0xFFFFFFU);
  return text.data();
}

PictureFormat picture_format(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".svg") return PictureFormat::svg;
  if (ending == ".png") return PictureFormat::png;
  if (ending == ".pdf") return PictureFormat::pdf;
  refuse("the picture " + asperity::quoted(file.string()) +
             (ending.empty() ? " has no ending" : " ends in " + ending),
         "pictures are .svg, .png or .pdf");
}

std::string gnuplot_terminal(PictureFormat format, int width, int height, double font_size,
                             std::optional<double> inches) {
  const std::string size = std::to_string(width) + "," + std::to_string(height);
  const std::string look = " noenhanced font 'DejaVu Sans," + format_short(font_size, 4) + "'";
  const std::string white = " background '#ffffff'\n";
  const double scale = inches ? 100 * *inches / width : 1;
  const auto scaled = [](double by) {
    const std::string factor = format_short(by, 6);
    return " linewidth " + factor + (by == 1 ? "" : " pointscale " + factor);
  };
  if (format == PictureFormat::png) {
    if (!inches) return "set terminal pngcairo size " + size + look + scaled(1) + white;
    const auto pixels = [&](int length) { return std::to_string(std::lround(3 * scale * length)); };
    // pngcairo has 96 pixels per inch for text.
    return "set terminal pngcairo size " + pixels(width) + "," + pixels(height) + look + scaled(3 * scale) +
           " fontscale " + format_short(2.25 * scale, 6) + white;
  }
  if (format == PictureFormat::pdf) {
    // 72 points and 100 pixels per inch.
    const auto inch = [&](int length) { return format_short(0.01 * scale * length, 6) + "in"; };
    return "set terminal pdfcairo size " + inch(width) + "," + inch(height) + look + scaled(scale) +
           " fontscale " + format_short(0.72 * scale, 6) + white;
  }
  return "set terminal svg size " + size + " dynamic" + look + scaled(1) + white;
}

std::string printed_at(std::string svg, double width, double height) {
  const auto length = [](double metres) { return "=\"" + format_short(1000 * metres, 6) + "mm\""; };
  const std::size_t at = svg.find("<svg");
  if (at != std::string::npos) svg.insert(at + 4, " width" + length(width) + " height" + length(height));
  return svg;
}

std::vector<std::string> complaints_of(const GnuplotResult& result, const fs::path& file) {
  if (result.messages.empty()) return {};
  constexpr std::size_t longest = 300;
  std::string said;
  for (const char c : result.messages.substr(0, longest)) said += c == '\n' ? ' ' : c;
  return {asperity::quoted(file.filename().string()) + " may look wrong; gnuplot reports: " + said +
          (result.messages.size() > longest ? " …" : "")};
}

bool leave_to_page() {
#if defined(__EMSCRIPTEN__)
  ++left;
  return true;
#else
  return false;
#endif
}
int pictures_left_to_page() { return left; }

void draw_pictures_by(std::function<GnuplotDrawer> other) { drawer() = std::move(other); }

std::string without_date(std::string picture) {
  if (!picture.starts_with("%PDF")) return picture;
  static constexpr std::string_view mark = "/CreationDate (D:", date = "20000101000000";
  // Cairo writes one uncompressed date near the end.
  const std::size_t at = picture.rfind(mark);
  if (at == std::string::npos) return picture;
  for (std::size_t k = 0; k < date.size() && at + mark.size() + k < picture.size(); ++k) {
    char& digit = picture[at + mark.size() + k];
    if (digit < '0' || digit > '9') break;
    digit = date[k];
  }
  return picture;
}

std::string script_for_file(std::string_view script) {
  const std::size_t canvas = script.find('\n') + 1;
  return "set encoding utf8\n" + std::string(script.substr(0, canvas)) + "set output 'picture'\n" +
         std::string(script.substr(canvas)) + "\nunset output\n";
}

GnuplotResult run_gnuplot(std::string_view script, std::span<const GnuplotData> data) {
  if (drawer()) {
    GnuplotResult drawn = drawer()(script, data);
    drawn.picture = without_date(std::move(drawn.picture));
    return drawn;
  }
  const TemporaryFolder folder("picture");
  write_atomically(folder.path() / "script", script_for_file(script));
  for (const GnuplotData& item : data) write_atomically(folder.path() / item.name, item.bytes);
  const int status = wait_for(start(folder.path()));
  GnuplotResult result{without_date(content_of(folder.path() / "picture")),
                       without_ends(content_of(folder.path() / "messages"))};
  const bool failed = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  // On some systems only the child detects a missing program.
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127 && result.messages.empty())
    refuse_state("charts and pictures are drawn by gnuplot, which is not installed",
                 "install the package gnuplot-nox");
  if (failed || result.picture.empty())
    throw Error(ErrorCode::internal, "gnuplot drew no picture" +
                                         (result.messages.empty() ? std::string() : ": " + result.messages));
  return result;
}

}  // namespace asperity
