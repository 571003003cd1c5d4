// SPDX-License-Identifier: GPL-3.0-or-later
// A connection for cpp-httplib with its missing limits: time and bytes of a request, and time to fetch the
// answer.
#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "bindings/web/http/http.hpp"

namespace asperity::web {

std::string lower(std::string text);

// Why the head of a request is not valid HTTP/1.1 (RFC 9112), or "". A strict parser before the library: two
// parsers could disagree about the end of a request (line ends, folded lines, spaces before a colon, two
// lengths, chunks), and bytes of one request could then pass as another. Such a head is refused and its
// connection closed. At most one length, in digits; no chunked body.
std::string_view head_problem(std::string_view head);

class DeadlineStream final : public httplib::Stream {
 public:
  DeadlineStream(int socket, const HttpSetup& setup) : socket_(socket), setup_(setup) {}

  // Waits for at most the idle time. The limits of a request apply from here.
  bool wait_for_request();
  enum class Head { whole, too_long, not_there };
  // Blocks; read() returns the head later. `head` is valid until the next read().
  Head wait_for_head(std::string_view& head);
  // The limits of the body apply from here.
  void head_is_read();

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  // Nobody reads addresses.
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  int socket() const override { return socket_; }
  using httplib::Stream::write;

 private:
  // Like recv, with the deadline.
  ssize_t receive();
  using Clock = std::chrono::steady_clock;

  int socket_;
  const HttpSetup& setup_;
  Clock::time_point arrived_by_{};
  std::size_t may_read_ = 0;  // bytes of this request
  std::size_t from_ = 0;      // unread bytes
  std::string buffer_;
  Clock::duration blocked_{};  // in sending
  std::size_t sent_ = 0;
};

}  // namespace asperity::web
