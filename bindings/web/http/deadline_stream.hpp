// SPDX-License-Identifier: GPL-3.0-or-later
// A connection for cpp-httplib with its missing limits: a request must arrive within a time and a number of
// bytes, and a client that does not fetch its answer is dropped.
#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "bindings/web/http/http.hpp"

namespace asperity::web {

class DeadlineStream final : public httplib::Stream {
 public:
  DeadlineStream(int socket, const HttpSetup& setup) : socket_(socket), setup_(setup) {}

  // Waits for at most the idle time.
  bool wait_for_request();
  void begin_request();
  enum class Head { whole, too_long, not_there };
  // Blocks; read() returns the head later. `head` is valid until the next read().
  Head wait_for_head(std::string_view& head);
  // The limits of the body apply from here.
  void head_is_read();

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& address, int& port) const override;
  void get_local_ip_and_port(std::string& address, int& port) const override;
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
