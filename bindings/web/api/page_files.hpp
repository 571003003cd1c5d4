// SPDX-License-Identifier: GPL-3.0-or-later
// The page's built files, read once at server start, so that no request reads the disk. Every answer carries
// a content policy: load from this server only, and run no script except these files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bindings/web/http/http.hpp"

namespace asperity::web {

class PageFiles {
 public:
  // `folder`: none if not built; "/" then explains the build.
  explicit PageFiles(const std::optional<std::filesystem::path>& folder);
  bool built() const { return !files_.empty(); }
  HttpResponse answer(const HttpRequest& request) const;

 private:
  struct File {
    std::string content, type, tag;
  };
  std::map<std::string, File> files_;  // by path: "/index.html"
};

// A sentence about building the page.
extern const char* const page_needs;

void add_safe_headers(HttpResponse& response);

}  // namespace asperity::web
