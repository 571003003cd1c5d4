// SPDX-License-Identifier: GPL-3.0-or-later
// A connection as cpp-httplib reads and writes it, with what its own lacks: a request arrives whole within a
// time and a number of bytes, however slowly its bytes come, and a client that does not fetch what it asked
// for is given up.
#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "bindings/web/http.hpp"

namespace asperity::web {

class DeadlineStream final : public httplib::Stream {
 public:
  DeadlineStream(int socket, const HttpSetup& setup) : socket_(socket), setup_(setup) {}

  // Whether a request begins within the time to rest.
  bool wait_for_request();
  void begin_request();
  enum class Head { whole, too_long, not_there };
  // Waits for the whole head, which read() then gives; `head` sees it until then.
  Head wait_for_head(std::string_view& head);
  // The head has been read: from here on its body counts.
  void head_is_read();

  bool is_readable() const override;
  // False once the client has gone.
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& address, int& port) const override;
  void get_local_ip_and_port(std::string& address, int& port) const override;
  int socket() const override { return socket_; }
  using httplib::Stream::write;

 private:
  // More bytes into the buffer: as recv, without waiting beyond the time that there is.
  ssize_t receive();
  using Clock = std::chrono::steady_clock;

  int socket_;
  const HttpSetup& setup_;
  Clock::time_point arrived_by_{};
  std::size_t may_read_ = 0;  // bytes of this request still
  std::size_t from_ = 0;      // where what is left in the buffer begins
  std::string buffer_;
  Clock::duration blocked_{};  // in sending, for this request
  std::size_t sent_ = 0;
};

}  // namespace asperity::web
