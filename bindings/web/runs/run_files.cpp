// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <utility>

#include "bindings/web/runs/answers.hpp"
#include "bindings/web/runs/page_run.hpp"
#include "bindings/web/sandbox/plain_files.hpp"

namespace asperity::web {

namespace {

HttpResponse file_stream(OpenFile file, std::string type, bool as_download) {
  auto reader = std::make_shared<Descriptor>(file.descriptor);
  HttpResponse response;
  response.type = std::move(type);
  response.headers = {{"Cache-Control", "no-store"}};
  if (as_download) response.headers.emplace_back("Content-Disposition", "attachment");
  response.stream = [reader, left = file.bytes](std::string& piece) mutable {
    piece.resize(static_cast<std::size_t>(std::min<std::int64_t>(left, std::int64_t{64} << 10)));
    const ssize_t got = piece.empty() ? 0 : ::read(reader->get(), piece.data(), piece.size());
    piece.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    left -= static_cast<std::int64_t>(piece.size());
    return !piece.empty() && left > 0;
  };
  return response;
}

}  // namespace

HttpResponse events_answer(const std::shared_ptr<PageRun>& run, const HttpRequest& request) {
  std::int64_t after = 0;
  if (const auto given = request.parameters.find("after"); given != request.parameters.end()) {
    const std::string& text = given->second;
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), after);
    if (wrong != std::errc() || end != text.data() + text.size() || after < 0)
      return problem_answer(400, "`after` is the number of an event");
  }
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  HttpResponse response;
  response.type = "application/x-ndjson";
  response.headers = {{"Cache-Control", "no-store"}};
  response.stream = [run, after, until](std::string& piece) mutable {
    bool more = true;
    piece = run->events.after(after, std::chrono::milliseconds(500), more);
    return more && std::chrono::steady_clock::now() < until;
  };
  return response;
}

HttpResponse file_answer(const PageRun& run, const std::string& name) {
  const bool hidden = name.starts_with('.') || name.find("/.") != std::string::npos;
  const auto file = hidden ? std::nullopt : open_plain_file(run.directory, name);
  if (!file) return problem_answer(404, "the run has no such file");
  // Opened directly, a script's file must not act as a page of this server.
  const std::string type = media_type(name);
  const bool harmless = type.starts_with("text/plain") || type.starts_with("text/csv") || type == "image/png";
  return file_stream(*file,
                     type.starts_with("text/html") || type.starts_with("text/javascript")
                         ? "text/plain; charset=utf-8"
                         : type,
                     !harmless);
}

HttpResponse view_answer(const PageRun& run, const std::string& name) {
  const bool plain = !name.empty() && name.size() < 64 && std::ranges::all_of(name, [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  const auto file = plain ? open_plain_file(run.directory, ".views/" + name + ".json") : std::nullopt;
  if (!file) return problem_answer(404, "the run has no such view");
  return file_stream(*file, "application/json", false);
}

}  // namespace asperity::web
