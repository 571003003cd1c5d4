// SPDX-License-Identifier: GPL-3.0-or-later
// The page's built files, read once at server start, so that no request reaches the disk. Every answer
// carries a content policy: the page loads from this server only and runs no script except these files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bindings/web/http.hpp"

namespace asperity::web {

class PageFiles {
 public:
  // `folder`: empty if the page was not built; "/" then says how to build the page.
  explicit PageFiles(const std::optional<std::filesystem::path>& folder);
  bool built() const { return !files_.empty(); }
  // Answers GET and HEAD.
  HttpResponse answer(const HttpRequest& request) const;

 private:
  struct File {
    std::string content, type, tag;
  };
  std::map<std::string, File> files_;  // by path, "/index.html"
};

// One sentence: how to build the page.
extern const char* const page_needs;

// For every answer of the server.
void add_safe_headers(HttpResponse& response);

}  // namespace asperity::web
