// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/http/request_head.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace asperity::web {

namespace {

constexpr std::string_view line_end = "\r\n";

bool is_token(std::string_view text) {
  constexpr std::string_view marks = "!#$%&'*+-.^_`|~";
  return !text.empty() && std::ranges::all_of(text, [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x80 && (std::isalnum(byte) != 0 || marks.find(c) != std::string_view::npos);
  });
}

// Visible ASCII and bytes beyond ASCII; with `blanks` also spaces and tabs.
bool is_shown(std::string_view text, bool blanks) {
  return std::ranges::all_of(text, [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte > 0x20 && byte != 0x7F) || (blanks && (c == ' ' || c == '\t'));
  });
}

bool is_request_line(std::string_view line) {
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return false;
  const std::string_view target = line.substr(first + 1, last - first - 1), version = line.substr(last + 1);
  return is_token(line.substr(0, first)) && !target.empty() && target[0] == '/' && is_shown(target, false) &&
         (version == "HTTP/1.1" || version == "HTTP/1.0");
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

}  // namespace

std::size_t head_bytes(std::string_view text) {
  const std::size_t end = text.find("\r\n\r\n");
  return end == std::string_view::npos ? 0 : end + 4;
}

std::string_view head_problem(std::string_view head) {
  std::size_t end = head.find(line_end);
  if (end == std::string_view::npos || !is_request_line(head.substr(0, end)))
    return "the first line is no request of HTTP/1.1";
  bool has_length = false;
  for (std::size_t begin = end + 2; begin < head.size(); begin = end + 2) {
    end = head.find(line_end, begin);
    if (end == std::string_view::npos) return "a line does not end as lines do";
    const std::string_view line = head.substr(begin, end - begin);
    if (line.empty()) return end + 2 == head.size() ? "" : "something follows the head";
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_token(line.substr(0, colon)))
      return "a line of the head is no field";
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (!is_shown(value, true)) return "a field holds control characters";
    std::string name(line.substr(0, colon));
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (name == "transfer-encoding") return "a body must come in one piece, with its length";
    if (name != "content-length") continue;
    if (has_length) return "the body has two lengths";
    has_length = true;
    if (value.empty() || value.size() > 18 || value.find_first_not_of("0123456789") != std::string_view::npos)
      return "the length of the body is no number";
  }
  return "the head does not end";
}

}  // namespace asperity::web
