// SPDX-License-Identifier: GPL-3.0-or-later
// The interface between the program and the part asperity-serve.so (bindings/web/http), which contains
// cpp-httplib. The part bounds a client's cost before the program sees a request: bytes, times to arrive and
// to be fetched, connections. At the limit, the connection with the longest wait for a request is closed:
// slow clients keep nobody out.
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
  std::map<std::string, std::string> parameters;             // first value of a name
  std::multimap<std::string, std::string> headers;           // lower-case names
  const std::string* header(const std::string& name) const;  // null if missing or repeated
};

struct HttpResponse {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers{};
  std::string type = "text/plain; charset=utf-8";
  std::string body{};
  // Replaces `body`: sets `piece` (empty at the call; may stay empty); false after the last piece. May block
  // for a second. One call at a time.
  std::function<bool(std::string& piece)> stream{};
};

struct HttpSetup {
  std::string address;  // "127.0.0.1"
  int port = 0;         // 0: any free port
  std::size_t most_head_bytes = std::size_t{32} << 10;
  std::size_t most_body_bytes = std::size_t{2} << 20;
  std::size_t most_connections = 256;
  std::chrono::seconds to_arrive{10};  // from connection or first byte
  std::chrono::seconds to_rest{10};    // between two requests
  std::chrono::seconds to_fetch{10};   // blocked in sending; 1 s more per 16 KiB
};

// Called by many threads. Must not throw.
class HttpHandler {
 public:
  virtual ~HttpHandler() = default;
  // Before the body: a final answer, or nothing.
  virtual std::optional<HttpResponse> refuse(const HttpRequest& head) = 0;
  virtual HttpResponse answer(const HttpRequest& request) = 0;
};

class HttpServer {
 public:
  virtual ~HttpServer() = default;
  virtual int port() const = 0;
  // Returns after stop(), from any thread.
  virtual void serve() = 0;
  virtual void stop() = 0;
};

// Symbol `asperity_http_server` of the part. Null if the server cannot listen (`problem`).
using MakeHttpServer = HttpServer*(const HttpSetup& setup, HttpHandler& handler, std::string& problem);

}  // namespace asperity::web
