// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/http/deadline_stream.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "bindings/web/http/request_head.hpp"

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

void address_of(const sockaddr_storage& storage, std::string& address, int& port) {
  char text[INET6_ADDRSTRLEN] = "";
  if (storage.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(storage);
    ::inet_ntop(AF_INET, &v4.sin_addr, text, sizeof text);
    port = ntohs(v4.sin_port);
  } else if (storage.ss_family == AF_INET6) {
    const auto& v6 = reinterpret_cast<const sockaddr_in6&>(storage);
    ::inet_ntop(AF_INET6, &v6.sin6_addr, text, sizeof text);
    port = ntohs(v6.sin6_port);
  }
  address = text;
}

}  // namespace

bool DeadlineStream::wait_for_request() {
  if (from_ < buffer_.size()) return true;
  return (wait_until(socket_, POLLIN, Clock::now() + setup_.to_rest) & POLLIN) != 0;
}

void DeadlineStream::begin_request() {
  arrived_by_ = Clock::now() + setup_.to_arrive;
  may_read_ = setup_.most_head_bytes;
  blocked_ = {};
  sent_ = 0;
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

void DeadlineStream::get_remote_ip_and_port(std::string& address, int& port) const {
  sockaddr_storage storage{};
  socklen_t length = sizeof storage;
  if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&storage), &length) == 0)
    address_of(storage, address, port);
}

void DeadlineStream::get_local_ip_and_port(std::string& address, int& port) const {
  sockaddr_storage storage{};
  socklen_t length = sizeof storage;
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&storage), &length) == 0)
    address_of(storage, address, port);
}

}  // namespace asperity::web
