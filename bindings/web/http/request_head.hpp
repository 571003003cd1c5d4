// SPDX-License-Identifier: GPL-3.0-or-later
// A strict parser for request heads, used before the library. Where two parsers could disagree about the end
// of a request (line ends, folded lines, spaces before a colon, two lengths, chunks), bytes of one request
// could pass as another; such a head is refused and its connection closed.
#pragma once

#include <cstddef>
#include <string_view>

namespace asperity::web {

// Length with the empty line; 0 if incomplete.
std::size_t head_bytes(std::string_view text);

// Why the head is not valid HTTP/1.1 (RFC 9112), or "". At most one length, in digits; no chunked body.
std::string_view head_problem(std::string_view head);

}  // namespace asperity::web
