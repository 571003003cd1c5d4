// SPDX-License-Identifier: GPL-3.0-or-later
// The page itself: its built files, read once when the server starts, so that no request reaches the disk.
// Every answer carries a policy that lets the page load from here and nowhere else, and run no script that is
// not one of these files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bindings/web/http.hpp"

namespace asperity::web {

class PageFiles {
 public:
  // `folder`: none where the page was not built; then "/" says what it needs.
  explicit PageFiles(const std::optional<std::filesystem::path>& folder);
  bool built() const { return !files_.empty(); }
  // For GET and HEAD.
  HttpResponse answer(const HttpRequest& request) const;

 private:
  struct File {
    std::string content, type, tag;
  };
  std::map<std::string, File> files_;  // by path, "/index.html"
};

// What the page needs to be built, in a sentence.
extern const char* const page_needs;

// Put on every answer of the server.
void add_safe_headers(HttpResponse& response);

}  // namespace asperity::web
