// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/page_files.hpp"

#include "bindings/web/sandbox/plain_files.hpp"
#include "engine/core/digest.hpp"

namespace asperity::web {

const char* const page_needs =
    "the page was not built: it needs npm (Debian's package npm); with it, configure and build again, "
    "`cmake --build build/release`";

PageFiles::PageFiles(const std::optional<std::filesystem::path>& folder) {
  constexpr std::size_t largest = std::size_t{32} << 20;
  if (!folder) return;
  std::int64_t bytes = 0;
  for (const PlainFile& file : plain_files(*folder, 1000, bytes)) {
    if (file.name[0] == '.' || file.name.find("/.") != std::string::npos || file.name.ends_with(".map"))
      continue;
    auto content = read_plain_file(*folder, file.name, largest);
    if (!content) continue;
    const std::string tag = "\"" + Digester().add(*content).hex() + "\"";
    files_["/" + file.name] = {*std::move(content), media_type(file.name), tag};
  }
  if (!files_.contains("/index.html")) files_.clear();
}

HttpResponse PageFiles::answer(const HttpRequest& request) const {
  if (!built()) return {.status = request.path == "/" ? 503 : 404, .body = std::string(page_needs) + "\n"};
  const auto found = files_.find(request.path == "/" ? "/index.html" : request.path);
  if (found == files_.end()) return {.status = 404, .body = "there is no such page\n"};
  const File& file = found->second;
  HttpResponse response{.headers = {{"ETag", file.tag}, {"Cache-Control", "no-cache"}}, .type = file.type};
  const std::string* known = request.header("if-none-match");
  if (known != nullptr && *known == file.tag)
    response.status = 304;
  else
    response.body = file.content;
  return response;
}

void add_safe_headers(HttpResponse& response) {
  response.headers.emplace_back(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; font-src 'self'; "
      "connect-src 'self'; worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; "
      "frame-ancestors 'none'");
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  response.headers.emplace_back("Referrer-Policy", "no-referrer");
  response.headers.emplace_back("X-Frame-Options", "DENY");
  response.headers.emplace_back("Cross-Origin-Opener-Policy", "same-origin");
  response.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
}

}  // namespace asperity::web
