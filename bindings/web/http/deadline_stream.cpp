// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/http/deadline_stream.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

namespace asperity::web {

namespace {

using Clock = std::chrono::steady_clock;

// The poll result; 0 at the deadline.
short wait_until(int socket, short events, Clock::time_point end) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd watched{socket, events, 0};
    const int ready = ::poll(&watched, 1, static_cast<int>(std::clamp<long>(left, 0, 1000 * 3600)));
    if (ready > 0) return watched.revents;
    if (ready < 0 && errno != EINTR) return POLLERR;
    if (Clock::now() >= end) return 0;
  }
}

constexpr std::string_view line_end = "\r\n";

bool is_token(std::string_view text) {
  constexpr std::string_view marks = "!#$%&'*+-.^_`|~";
  return !text.empty() && std::ranges::all_of(text, [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x80 && (std::isalnum(byte) != 0 || marks.find(c) != std::string_view::npos);
  });
}

// Visible ASCII and beyond; with `blanks` also spaces and tabs.
bool is_shown(std::string_view text, bool blanks) {
  return std::ranges::all_of(text, [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte > 0x20 && byte != 0x7F) || (blanks && (c == ' ' || c == '\t'));
  });
}

bool is_request_line(std::string_view line) {
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return false;
  const std::string_view target = line.substr(first + 1, last - first - 1), version = line.substr(last + 1);
  return is_token(line.substr(0, first)) && !target.empty() && target[0] == '/' && is_shown(target, false) &&
         (version == "HTTP/1.1" || version == "HTTP/1.0");
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// With the empty line; 0 if incomplete.
std::size_t head_bytes(std::string_view text) {
  const std::size_t end = text.find("\r\n\r\n");
  return end == std::string_view::npos ? 0 : end + 4;
}

}  // namespace

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string_view head_problem(std::string_view head) {
  std::size_t end = head.find(line_end);
  if (end == std::string_view::npos || !is_request_line(head.substr(0, end)))
    return "the first line is no request of HTTP/1.1";
  bool has_length = false;
  for (std::size_t begin = end + 2; begin < head.size(); begin = end + 2) {
    end = head.find(line_end, begin);
    if (end == std::string_view::npos) return "a line has a wrong end";
    const std::string_view line = head.substr(begin, end - begin);
    if (line.empty()) return end + 2 == head.size() ? "" : "something follows the head";
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_token(line.substr(0, colon)))
      return "a line of the head is no field";
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (!is_shown(value, true)) return "a field holds control characters";
    const std::string name = lower(std::string(line.substr(0, colon)));
    if (name == "transfer-encoding") return "a body must come in one piece, with its length";
    if (name != "content-length") continue;
    if (has_length) return "the body has two lengths";
    has_length = true;
    if (value.empty() || value.size() > 18 || value.find_first_not_of("0123456789") != std::string_view::npos)
      return "the length of the body is no number";
  }
  return "the head does not end";
}

bool DeadlineStream::wait_for_request() {
  if (from_ == buffer_.size() && (wait_until(socket_, POLLIN, Clock::now() + setup_.to_rest) & POLLIN) == 0)
    return false;
  arrived_by_ = Clock::now() + setup_.to_arrive;
  may_read_ = setup_.most_head_bytes;
  blocked_ = {};
  sent_ = 0;
  return true;
}

ssize_t DeadlineStream::receive() {
  if ((wait_until(socket_, POLLIN, arrived_by_) & POLLIN) == 0) return -1;
  char piece[4096];
  ssize_t got = 0;
  do got = ::recv(socket_, piece, sizeof piece, MSG_DONTWAIT);
  while (got < 0 && errno == EINTR);
  if (got <= 0) return got;
  buffer_.erase(0, from_);
  from_ = 0;
  buffer_.append(piece, static_cast<std::size_t>(got));
  return got;
}

DeadlineStream::Head DeadlineStream::wait_for_head(std::string_view& head) {
  for (;;) {
    const std::string_view arrived = std::string_view(buffer_).substr(from_);
    if (const std::size_t bytes = head_bytes(arrived); bytes > 0) {
      head = arrived.substr(0, bytes);
      return bytes > setup_.most_head_bytes ? Head::too_long : Head::whole;
    }
    if (arrived.size() > setup_.most_head_bytes) return Head::too_long;
    if (receive() <= 0) return Head::not_there;
  }
}

void DeadlineStream::head_is_read() { may_read_ = setup_.most_body_bytes + 4096; }

bool DeadlineStream::is_readable() const {
  return from_ < buffer_.size() || (wait_until(socket_, POLLIN, arrived_by_) & POLLIN) != 0;
}

bool DeadlineStream::is_writable() const {
  pollfd watched{socket_, POLLRDHUP, 0};
  return ::poll(&watched, 1, 0) >= 0 && (watched.revents & (POLLRDHUP | POLLHUP | POLLERR)) == 0;
}

ssize_t DeadlineStream::read(char* to, std::size_t size) {
  if (may_read_ == 0) return -1;
  size = std::min(size, may_read_);
  if (from_ == buffer_.size())
    if (const ssize_t got = receive(); got <= 0) return got;
  const std::size_t taken = std::min(size, buffer_.size() - from_);
  std::memcpy(to, buffer_.data() + from_, taken);
  from_ += taken;
  may_read_ -= taken;
  return static_cast<ssize_t>(taken);
}

ssize_t DeadlineStream::write(const char* from, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t sent = ::send(socket_, from + done, size - done, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      done += static_cast<std::size_t>(sent);
      sent_ += static_cast<std::size_t>(sent);
      continue;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN && errno != EWOULDBLOCK) return -1;
    const auto begun = Clock::now();
    const auto may_block = setup_.to_fetch + std::chrono::seconds(sent_ >> 14) - blocked_;
    const short state = wait_until(socket_, POLLOUT, begun + may_block);
    blocked_ += Clock::now() - begun;
    if ((state & POLLOUT) == 0) return -1;
  }
  return static_cast<ssize_t>(size);
}

}  // namespace asperity::web
