// SPDX-License-Identifier: GPL-3.0-or-later
// The part asperity-serve.so: cpp-httplib within the bounds of bindings/web/http/http.hpp. Its unpacking,
// compression, ranges and forms are disabled: a short request could make them expensive.
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "bindings/web/http/deadline_stream.hpp"
#include "bindings/web/http/http.hpp"

namespace asperity::web {

namespace {

// Connections in wait for their client. Thread-safe.
class Connections {
 public:
  // Until end(), the connection may be shut down.
  class Waiting {
   public:
    Waiting(Connections& connections, int socket) : connections_(connections) {
      const std::lock_guard lock(connections_.mutex_);
      number_ = ++connections_.last_;
      connections_.waiting_.emplace(number_, socket);
    }
    ~Waiting() { end(); }
    void end() {
      const std::lock_guard lock(connections_.mutex_);
      connections_.waiting_.erase(number_);
    }
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

   private:
    Connections& connections_;
    std::uint64_t number_;
  };

  void make_room() {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return;
    // The connection's thread leaves the list before closing the socket.
    ::shutdown(waiting_.begin()->second, SHUT_RDWR);
    waiting_.erase(waiting_.begin());
  }
  void shut_down_all() {
    const std::lock_guard lock(mutex_);
    for (const auto& [number, socket] : waiting_) ::shutdown(socket, SHUT_RDWR);
  }

 private:
  std::mutex mutex_;
  std::uint64_t last_ = 0;
  std::map<std::uint64_t, int> waiting_;  // oldest first
};

// A bounded number of threads, one for each connection, reused for a while. At the limit, a waiting
// connection makes room.
class ConnectionThreads final : public httplib::TaskQueue {
 public:
  ConnectionThreads(std::size_t most, Connections& connections) : most_(most), connections_(connections) {}

  void enqueue(std::function<void()> serve) override {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(serve));
    if (queue_.size() <= idle_) {
      changed_.notify_one();
      return;
    }
    if (threads_ < most_) {
      try {
        std::thread([this] { work(); }).detach();
        ++threads_;
        return;
      } catch (const std::system_error&) {
        // No more threads: as at the limit.
      }
    }
    connections_.make_room();
  }

  void shutdown() override {
    std::unique_lock lock(mutex_);
    over_ = true;
    changed_.notify_all();
    connections_.shut_down_all();
    changed_.wait(lock, [&] { return threads_ == 0; });
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      ++idle_;
      const bool woken =
          changed_.wait_for(lock, std::chrono::seconds(30), [&] { return over_ || !queue_.empty(); });
      --idle_;
      if (queue_.empty() && (over_ || !woken)) break;
      const std::function<void()> serve = std::move(queue_.front());
      queue_.pop_front();
      lock.unlock();
      serve();
      lock.lock();
    }
    --threads_;
    changed_.notify_all();
  }

  const std::size_t most_;
  Connections& connections_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::function<void()>> queue_;
  std::size_t threads_ = 0, idle_ = 0;
  bool over_ = false;
};

struct Here {
  Connections::Waiting* waiting = nullptr;
  bool close = false;
  std::string encodings{};  // Accept-Encoding, hidden from the library
};
thread_local Here here;

HttpRequest head_of(const httplib::Request& from) {
  HttpRequest request;
  request.method = from.method;
  request.path = from.path;
  for (const auto& [name, value] : from.params) request.parameters.emplace(name, value);
  for (const auto& [name, value] : from.headers) request.headers.emplace(lower(name), value);
  if (!here.encodings.empty()) request.headers.emplace("accept-encoding", here.encodings);
  return request;
}

void put(HttpResponse from, httplib::Response& to) {
  to.status = from.status;
  for (const auto& [name, value] : from.headers) to.set_header(name, value);
  if (!from.stream) {
    to.set_content(from.body, from.type);
    return;
  }
  auto stream = std::make_shared<std::function<bool(std::string&)>>(std::move(from.stream));
  to.set_chunked_content_provider(from.type, [stream](std::size_t, httplib::DataSink& sink) {
    // Notices a disconnected client.
    if (!sink.is_writable()) return false;
    std::string piece;
    const bool more = (*stream)(piece);
    if (!piece.empty() && !sink.write(piece.data(), piece.size())) return false;
    if (!more) sink.done();
    return true;
  });
}

class Server final : public HttpServer, private httplib::Server {
 public:
  Server(const HttpSetup& setup, HttpHandler& handler) : setup_(setup), handler_(handler) {}

  bool begin(std::string& problem);
  int port() const override { return port_; }
  void serve() override {
    listen_after_bind();
    over_ = true;
  }
  // The base class ignores an early stop.
  void stop() override {
    while (!is_running() && !over_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    httplib::Server::stop();
    connections_.shut_down_all();
  }

 private:
  bool process_and_close_socket(int socket) override;
  void answer_with_body(const httplib::Request& from, httplib::Response& to,
                        const httplib::ContentReader& read);

  const HttpSetup setup_;
  HttpHandler& handler_;
  Connections connections_;
  int port_ = 0;
  std::atomic<bool> over_ = false;
};

bool Server::begin(std::string& problem) {
  new_task_queue = [this] { return new ConnectionThreads(setup_.most_connections, connections_); };
  set_payload_max_length(setup_.most_body_bytes);
  set_tcp_nodelay(true);
  // By default another program of this user could share the port.
  set_socket_options([](int socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  set_pre_routing_handler([this](const httplib::Request& from, httplib::Response& to) {
    const HttpRequest head = head_of(from);
    if (auto refused = handler_.refuse(head)) {
      here.close = true;  // an unread body may follow
      put(*std::move(refused), to);
      return HandlerResponse::Handled;
    }
    if (from.method == "POST") return HandlerResponse::Unhandled;
    put(handler_.answer(head), to);
    return HandlerResponse::Handled;
  });
  Post("/api/.*", [this](const httplib::Request& from, httplib::Response& to,
                         const httplib::ContentReader& read) { answer_with_body(from, to, read); });
  if (setup_.port == 0) {
    port_ = bind_to_any_port(setup_.address);
  } else {
    port_ = bind_to_port(setup_.address, setup_.port) ? setup_.port : -1;
  }
  if (port_ <= 0) {
    problem = std::strerror(errno);
    return false;
  }
  // For a whole classroom; the library's backlog is five.
  ::listen(svr_sock_, 512);
  return true;
}

void Server::answer_with_body(const httplib::Request& from, httplib::Response& to,
                              const httplib::ContentReader& read) {
  HttpRequest request = head_of(from);
  const bool whole = read([&](const char* bytes, std::size_t count) {
    if (request.body.size() + count > setup_.most_body_bytes) return false;
    request.body.append(bytes, count);
    return true;
  });
  if (!whole) {
    to.status = 400;
    here.close = true;
    return;
  }
  here.waiting->end();
  put(handler_.answer(request), to);
}

void refuse_head(DeadlineStream& stream, const char* status, std::string_view problem) {
  const std::string body = "{\"error\":{\"message\":\"" + std::string(problem) + "\"}}\n";
  const std::string answer = std::string("HTTP/1.1 ") + status +
                             "\r\nConnection: close\r\nContent-Type: application/json\r\nContent-Length: " +
                             std::to_string(body.size()) + "\r\n\r\n" + body;
  stream.write(answer.data(), answer.size());
}

bool Server::process_and_close_socket(int socket) {
  DeadlineStream stream(socket, setup_);
  constexpr int most_requests = 1000;
  for (int k = 0; k < most_requests && svr_sock_ >= 0; ++k) {
    Connections::Waiting waiting(connections_, socket);
    if (!stream.wait_for_request()) break;
    std::string_view head;
    const DeadlineStream::Head arrived = stream.wait_for_head(head);
    if (arrived == DeadlineStream::Head::not_there) break;
    if (arrived == DeadlineStream::Head::too_long) {
      refuse_head(stream, "431 Request Header Fields Too Large", "the head of the request is too long");
      break;
    }
    if (const std::string_view problem = head_problem(head); !problem.empty()) {
      refuse_head(stream, "400 Bad Request", problem);
      break;
    }
    here = {&waiting};
    bool closed = false;
    const bool good = process_request(stream, k + 1 == most_requests, closed, [&](httplib::Request& request) {
      stream.head_is_read();
      here.encodings = request.get_header_value("Accept-Encoding");
      request.headers.erase("Accept-Encoding");
      request.headers.erase("Range");
      request.ranges.clear();
      // A POST may be shut down until its body has arrived.
      if (request.method != "POST") waiting.end();
    });
    if (!good || closed || here.close) break;
  }
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return true;
}

}  // namespace

}  // namespace asperity::web

extern "C" __attribute__((visibility("default"))) asperity::web::HttpServer* asperity_http_server(
    const asperity::web::HttpSetup& setup, asperity::web::HttpHandler& handler, std::string& problem) {
  auto server = std::make_unique<asperity::web::Server>(setup, handler);
  return server->begin(problem) ? server.release() : nullptr;
}
