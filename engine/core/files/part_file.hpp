// SPDX-License-Identifier: GPL-3.0-or-later
// Names of files that are written aside and renamed when they are whole: ".NAME.WRITER.part.EXTENSION", where
// WRITER is host and process as 8 and up to 10 digits and 64 random bits, so that processes of several hosts
// and containers never write one file. A writer that is killed leaves its part behind; the name says whether
// it may still be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace asperity {

// A name beside `target` that no other writer has, at most 255 bytes long. The extension stays last, because
// some writers choose their format by it.
std::filesystem::path part_beside(const std::filesystem::path& target);

// The name tells where its writer runs. A process that will be shut off from /proc finds that out before.
void find_own_place();

// Whether a file is a part by its name, of this version or of one before it.
bool is_part(const std::filesystem::path& file);

// Whether nobody can be writing this part: its process was of this host and has ended, or nothing has been
// written to the part for a day.
bool is_abandoned(const std::filesystem::path& part);

// Removes parts from a folder: those that are abandoned, or, where the caller knows that nobody else writes
// there, every one. Links are not followed. Folders inside are gone through as well if `deep`. What cannot be
// read or removed stays. Returns how many were removed.
enum class Parts { abandoned, all };
int sweep_parts(const std::filesystem::path& folder, Parts which, bool deep = false);

}  // namespace asperity
