// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of any bytes through a pipe or a socket: how many there are, then each after its length. Who reads
// says how many bytes they may be together, for the other end may be a script that has got loose.
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
// Waits for a whole frame. None where the other end is gone, or sent what is no frame or is too long.
std::optional<std::vector<std::string>> receive_frame(int descriptor, std::size_t most_bytes);

// The first whole frame of what has arrived, which is taken out of it; none where more has to come. Throws
// Error{bad_file} for what is no frame or is too long.
std::optional<std::vector<std::string>> take_frame(std::string& arrived, std::size_t most_bytes);

// Everything, however often it is interrupted; false if the other end is gone.
bool read_whole(int descriptor, char* to, std::size_t bytes);

}  // namespace asperity::web
