// SPDX-License-Identifier: GPL-3.0-or-later
// The head of a request, read strictly before the library sees a byte of it. Where two readers could disagree
// about where a request ends (line ends, folded lines, blanks before a colon, two lengths, pieces), the bytes
// of one request may be taken for another: such a head is refused, and its connection closed.
#pragma once

#include <cstddef>
#include <string_view>

namespace asperity::web {

// Bytes up to and with the empty line that ends it; 0 while that has not come.
std::size_t head_bytes(std::string_view text);

// Why it is no head of HTTP/1.1 as RFC 9112 writes it, "" if it is one; with one length at most, in digits,
// and no body in pieces. `head` ends with its empty line.
std::string_view head_problem(std::string_view head);

}  // namespace asperity::web
