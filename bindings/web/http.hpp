// SPDX-License-Identifier: GPL-3.0-or-later
// The server of pages and requests, without its library: what the program and the part asperity-serve.so
// (bindings/web/http), which brings cpp-httplib, say to each other. The part bounds what a client may cost
// before the program hears of it: bytes of a request, the time it may take to arrive and to be fetched, and
// the connections there are at once. When these are used up, the one that has waited longest without
// sending a request is closed, so that slow clients never keep others out.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity::web {

struct HttpRequest {
  std::string method;  // "GET"
  std::string path;    // decoded, without the query
  std::string body;
  std::map<std::string, std::string> parameters;             // of the query; the first of each name
  std::multimap<std::string, std::string> headers;           // names in lower case
  const std::string* header(const std::string& name) const;  // null if there is none, or more than one
};

struct HttpResponse {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers{};
  std::string type = "text/plain; charset=utf-8";
  std::string body{};
  // Instead of `body`: puts what comes next into `piece`, which is empty at the call and may stay empty, and
  // returns false after the last. It may wait up to a second. Called from one thread at a time.
  std::function<bool(std::string& piece)> stream{};
};

struct HttpSetup {
  std::string address;  // "127.0.0.1"
  int port = 0;         // 0: any that is free
  std::size_t most_head_bytes = std::size_t{32} << 10;
  std::size_t most_body_bytes = std::size_t{2} << 20;
  std::size_t most_connections = 256;
  std::chrono::seconds to_arrive{10};  // for a whole request, from its first byte or the connection's begin
  std::chrono::seconds to_rest{10};    // between two requests
  std::chrono::seconds to_fetch{10};   // blocked in sending; one more for every 16 KiB that were sent
};

// Called from many threads at once. Must not throw.
class HttpHandler {
 public:
  virtual ~HttpHandler() = default;
  // After the head and before the body: an answer that ends the matter, or nothing.
  virtual std::optional<HttpResponse> refuse(const HttpRequest& head) = 0;
  virtual HttpResponse answer(const HttpRequest& request) = 0;
};

class HttpServer {
 public:
  virtual ~HttpServer() = default;
  virtual int port() const = 0;
  // Answers until stop(), which may be called from any thread and returns at once.
  virtual void serve() = 0;
  virtual void stop() = 0;
};

// The part's symbol `asperity_http_server`. Null if the address cannot be listened on, with why in `problem`.
using MakeHttpServer = HttpServer*(const HttpSetup& setup, HttpHandler& handler, std::string& problem);

}  // namespace asperity::web
