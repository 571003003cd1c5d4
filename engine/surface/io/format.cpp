// SPDX-License-Identifier: GPL-3.0-or-later
// List of formats, and choice among them. A new format needs one source file and one line here
// (docs/contributor.md).
#include "engine/surface/io/format.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/foreign_format.hpp"
#include "engine/surface/io/own_head.hpp"

// In the order of trying. NAME_format() returns the record.
// clang-format off
#define ASPERITY_FORMATS(format) \
  format(npy)        \
  format(x3p)        \
  format(hdf5)       \
  format(gwy)        \
  format(sur)        \
  format(opd)        \
  format(sdf)        \
  format(bcr)        \
  format(metropro)   \
  format(al3d)       \
  format(frt)        \
  format(nms)        \
  format(plu)        \
  format(nanoscope)  \
  format(opdx)       \
  format(nid)        \
  format(ibw)        \
  format(mi)         \
  format(wsxm)       \
  format(park)       \
  format(stylus_csv) \
  format(xyz)        \
  format(text)       \
  /* end of the list */
// clang-format on

namespace asperity {

#define ASPERITY_DECLARED(name) const Format& name##_format();
ASPERITY_FORMATS(ASPERITY_DECLARED)
#undef ASPERITY_DECLARED

std::span<const Format* const> formats() {
#define ASPERITY_LISTED(name) &name##_format(),
  static const std::array all{ASPERITY_FORMATS(ASPERITY_LISTED)};
#undef ASPERITY_LISTED
  return all;
}

void require_format(const SourceFile& file, bool recognised, const char* finding) {
  if (!recognised) refuse_file(file, finding, "if it is another format, name it with `format`");
}

namespace {

bool has_extension_of(const Format& format, const SourceFile& file) {
  return std::ranges::find(format.extensions, file.extension()) != format.extensions.end();
}

const Format& if_certain(const Format& format, const SourceFile& file) {
  if (&format != &text_format()) return format;
  if (has_extension_of(xyz_format(), file)) return xyz_format();
  if (const auto head = own_head(file)) refuse_uncertain_lattice(file, *head);
  if (almost_triples(file))
    refuse_file(
        file,
        "has three columns, of which the first two hold almost all points of a lattice: it may be x y z "
        "triples, some missing or given twice, or a matrix of heights",
        "say which: `format` = \"xyz\" or `format` = \"text\"");
  if (many_triples(file))
    refuse_file(
        file,
        "has three columns and a hundred lines or more: it may be x y z points that are not on a lattice, or "
        "a matrix of heights",
        "grid the points first, or say `format` = \"text\"");
  if (may_be_triples(file))
    refuse_file(file,
                "has three columns: it may be x y z points of a lattice with holes, or a matrix of heights",
                "say which: `format` = \"xyz\" for points with holes, or `format` = \"text\" for a matrix");
  return format;
}

}  // namespace

void turn_over(Field& field) {
  for (int low = 0, high = field.ny() - 1; low < high; ++low, --high)
    std::ranges::swap_ranges(field.row(low), field.row(high));
}

const Format* format_of_extension(std::string_view extension) {
  for (const Format* format : formats())
    if (std::ranges::find(format->extensions, extension) != format->extensions.end()) return format;
  return nullptr;
}

const Format& choose_format(const SourceFile& file, const std::string& forced) {
  std::vector<std::string> names;
  std::vector<std::string> marks;
  for (const Format* format : formats()) {
    names.push_back(quoted(format->name));
    marks.push_back(std::string(format->name) + " (" + std::string(format->marks) + ")");
  }
  if (!forced.empty()) {
    std::vector<std::string> plain;
    for (const Format* format : formats()) {
      if (format->name == forced) return *format;
      plain.emplace_back(format->name);
    }
    throw Error(ErrorCode::unknown_name, "`format` is \"" + forced + "\"" + did_you_mean(forced, plain),
                "known formats are " + joined(names, " and "));
  }
  for (const Format* format : formats())
    if (format->recognises(file)) return if_certain(*format, file);
  if (const std::optional<ForeignFormat> foreign = foreign_format(file))
    refuse_file(file, "is " + foreign->what + ", which is not read", foreign->cure);
  for (const Format* format : formats())
    if (has_extension_of(*format, file)) return if_certain(*format, file);
  refuse_file(file, "is of no known format; looked for " + joined(marks, " and "),
              "if it is one of them, name it with `format`");
}

}  // namespace asperity
