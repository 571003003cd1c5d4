// SPDX-License-Identifier: GPL-3.0-or-later
// A strict parser for the head of a request, before the library sees a byte. Two parsers could disagree about
// the end of a request (line ends, folded lines, spaces before a colon, two lengths, chunks); bytes of one
// request would then pass as another. Such a head is refused and its connection closed.
#pragma once

#include <cstddef>
#include <string_view>

namespace asperity::web {

// The bytes up to and including the terminating empty line; 0 if incomplete.
std::size_t head_bytes(std::string_view text);

// Why the head is not valid HTTP/1.1 (RFC 9112), or "". At most one length, in digits, and no chunked body.
// `head` includes its empty line.
std::string_view head_problem(std::string_view head);

}  // namespace asperity::web
