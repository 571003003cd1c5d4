// SPDX-License-Identifier: GPL-3.0-or-later
// A new format needs one source file and one line here (docs/contributor.md).
#include "engine/surface/io/format.hpp"

#include "engine/core/text.hpp"
#include "engine/surface/io/foreign_format.hpp"
#include "engine/surface/io/own_head.hpp"

// In the order of trying. NAME_format is the record.
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

#define ASPERITY_DECLARED(name) extern const Format name##_format;
ASPERITY_FORMATS(ASPERITY_DECLARED)
#undef ASPERITY_DECLARED

std::span<const Format* const> formats() {
#define ASPERITY_LISTED(name) &name##_format,
  static constexpr std::array all{ASPERITY_FORMATS(ASPERITY_LISTED)};
#undef ASPERITY_LISTED
  return all;
}

namespace {

bool has_extension(const Format& format, std::string_view extension) {
  return std::ranges::find(format.extensions, extension) != format.extensions.end();
}

const Format& if_marked(const Format& format, const SourceFile& file) {
  if (!format.reads_unrecognised && !format.recognises(file))
    refuse_file(file,
                "lacks the mark of the format " + quoted(format.name) + ": " + std::string(format.marks),
                "if it is another format, name it with `format`");
  return format;
}

const Format& if_certain(const Format& format, const SourceFile& file) {
  if (&format != &text_format) return format;
  if (has_extension(xyz_format, file.extension())) return xyz_format;
  if (const auto head = own_head(file)) refuse_uncertain_lattice(file, *head);
  refuse_uncertain_points(file);
  return format;
}

}  // namespace

void turn_over(Field& field) {
  for (int low = 0, high = field.ny() - 1; low < high; ++low, --high)
    std::ranges::swap_ranges(field.row(low), field.row(high));
}

const Format* format_of_extension(std::string_view extension) {
  const auto found = std::ranges::find_if(
      formats(), [&](const Format* format) { return has_extension(*format, extension); });
  return found == formats().end() ? nullptr : *found;
}

const Format& choose_format(const SourceFile& file, const std::string& forced) {
  if (!forced.empty()) {
    std::vector<std::string> names, quoted_names;
    for (const Format* format : formats()) {
      if (format->name == forced) return if_marked(*format, file);
      names.emplace_back(format->name);
      quoted_names.push_back(quoted(format->name));
    }
    refuse_name("`format` is \"" + forced + "\"" + did_you_mean(forced, names),
                "known formats are " + joined(quoted_names, " and "));
  }
  for (const Format* format : formats())
    if (format->recognises(file)) return if_certain(*format, file);
  if (const std::optional<ForeignFormat> foreign = foreign_format(file))
    refuse_file(file, "is " + foreign->what + ", which is not read", foreign->cure);
  if (const Format* const format = format_of_extension(file.extension()))
    return if_certain(if_marked(*format, file), file);
  std::vector<std::string> marks;
  for (const Format* format : formats())
    marks.push_back(std::string(format->name) + " (" + std::string(format->marks) + ")");
  refuse_file(file, "is of no known format; looked for " + joined(marks, " and "),
              "if it is one of them, name it with `format`");
}

}  // namespace asperity
