// SPDX-License-Identifier: GPL-3.0-or-later
// Runs gnuplot (a separate program, without a shell) on a script and returns the picture it drew.
// Text reaches the script only through gnuplot_text, as a single-quoted string in which gnuplot
// substitutes nothing; numbers only through gnuplot_number. Bulk data go as attached files. The same
// script and data give the same bytes: no user settings are read, and the date that a PDF bears is a fixed
// one.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// A literal that means exactly this text on one line: quotes doubled, control characters made spaces,
// bytes that are not UTF-8 made "?", cut after 200 characters with "…".
std::string gnuplot_text(std::string_view text);
// A finite number; exact.
std::string gnuplot_number(double value);
// A colour 0xRRGGBB as "rgb '#rrggbb'".
std::string gnuplot_colour(unsigned rgb);

enum class PictureFormat { svg, png, pdf };
// By the ending of the name. Throws Error{bad_value} for any other ending.
PictureFormat picture_format(const std::filesystem::path& file);

// The opening line of the canvas, of `width` × `height` pixels, with text of `font_size` points; in a PDF a
// hundred pixels are an inch, and text keeps its share of the width.
std::string gnuplot_terminal(PictureFormat format, int width, int height, double font_size);

// A file the script reads by its name.
struct GnuplotData {
  std::string name;
  std::string bytes;
};

struct GnuplotResult {
  std::string picture;   // the bytes of the file
  std::string messages;  // gnuplot's standard error; empty without problems
};

// Warnings from gnuplot's messages about a finished picture, with the name of the file: the picture may look
// wrong (for example, gnuplot could not open a font or a file).
std::vector<std::string> complaints_of(const GnuplotResult& result, const std::filesystem::path& file);

// The drawer for a process without permission to start programs: another process draws its pictures.
using GnuplotDrawer = GnuplotResult(std::string_view script, std::span<const GnuplotData> data);
// From now on, in the whole process; not while a picture is drawn.
void draw_pictures_by(std::function<GnuplotDrawer> drawer);

// A PDF with its date of making (D:yyyymmddhhmmss) replaced by the first second of 2000, so that replay gives
// the same bytes; any other picture as it is.
std::string without_date(std::string picture);

// The script for gnuplot, with the picture in the file `picture` of the working directory.
std::string script_for_file(std::string_view script);

// Runs the script, whose canvas must be the first line, in a new temporary directory. Checks the stop flag
// while waiting. Thread-safe. Throws Error{bad_state} when gnuplot is not installed, Error{bad_file} when the
// temporary directory cannot be written, Error{internal} with gnuplot's own words when it fails or draws
// nothing.
GnuplotResult run_gnuplot(std::string_view script, std::span<const GnuplotData> data = {});

}  // namespace asperity
