// SPDX-License-Identifier: GPL-3.0-or-later
// Runs gnuplot, without a shell. Text enters scripts only through gnuplot_text (single-quoted, no
// substitution), numbers only through gnuplot_number, bulk data as files. Equal input gives equal bytes: no
// user settings, fixed PDF date.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// One line of 200 characters at most: apostrophes become ’, control characters spaces, invalid UTF-8 "?".
std::string gnuplot_text(std::string_view text);
// `value` is finite; the text is exact.
std::string gnuplot_number(double value);
// 0xRRGGBB as "rgb '#rrggbb'".
std::string gnuplot_colour(unsigned rgb);

enum class PictureFormat { svg, png, pdf };
// From the file ending. Throws Error{bad_value} for others.
PictureFormat picture_format(const std::filesystem::path& file);

// First line of a script: canvas in pixels (PDF: 100 per inch), text in points. `inches`: width in print
// (PNG: 300 pixels per inch; SVG: printed_at).
std::string gnuplot_terminal(PictureFormat format, int width, int height, double font_size,
                             std::optional<double> inches = {});
// The SVG with a width and a height in millimetres.
std::string printed_at(std::string svg, double width, double height);

struct GnuplotData {
  std::string name;
  std::string bytes;
};

struct GnuplotResult {
  std::string picture;   // file content
  std::string messages;  // gnuplot's standard error; empty without problems
};

std::vector<std::string> complaints_of(const GnuplotResult& result, const std::filesystem::path& file);

// Under WebAssembly no program starts: counts a picture that the page draws from its event, and returns true.
bool leave_to_page();
int pictures_left_to_page();

// Draws for processes that may not start programs.
using GnuplotDrawer = GnuplotResult(std::string_view script, std::span<const GnuplotData> data);
// For the whole process; not during drawing.
void draw_pictures_by(std::function<GnuplotDrawer> drawer);

// Sets the creation date of a PDF to the start of 2000.
std::string without_date(std::string picture);

// Script that writes the file `picture` in the working directory.
std::string script_for_file(std::string_view script);

// In a new temporary directory, checking the stop flag. Thread-safe. Throws Error{bad_state} without gnuplot,
// Error{bad_file} without the directory, Error{internal} with gnuplot's message.
GnuplotResult run_gnuplot(std::string_view script, std::span<const GnuplotData> data = {});

}  // namespace asperity
