// SPDX-License-Identifier: GPL-3.0-or-later
// Byte strings through a pipe or socket: their number, then each after its length. The reader bounds the
// total size: the sender may be hostile.
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
// Blocks. None if the other end is closed or the frame is malformed or too long.
std::optional<std::vector<std::string>> receive_frame(int descriptor, std::size_t most_bytes);

// Removes the first complete frame; none if incomplete. Throws Error{bad_file} if malformed or too long.
std::optional<std::vector<std::string>> take_frame(std::string& arrived, std::size_t most_bytes);

// Retries after interrupts; false at a closed end.
bool read_whole(int descriptor, char* to, std::size_t bytes);

}  // namespace asperity::web
