// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of any bytes through a pipe or a socket: the number of texts, then each text after its length. The
// reader sets the largest total size, because the sender may be a hostile script.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::web {

std::string frame(std::span<const std::string_view> texts);
bool send_frame(int descriptor, std::span<const std::string_view> texts);
// Blocks until a frame is complete. Returns none if the other end is closed or the frame is malformed or too
// long.
std::optional<std::vector<std::string>> receive_frame(int descriptor, std::size_t most_bytes);

// Removes the first complete frame from `arrived`; none if the frame is incomplete. Throws Error{bad_file}
// for a malformed or too long frame.
std::optional<std::vector<std::string>> take_frame(std::string& arrived, std::size_t most_bytes);

// Reads all bytes despite interrupts; false if the other end is closed.
bool read_whole(int descriptor, char* to, std::size_t bytes);

}  // namespace asperity::web
