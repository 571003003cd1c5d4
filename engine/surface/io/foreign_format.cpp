// SPDX-License-Identifier: GPL-3.0-or-later
// Marks from the formats' owners or Gwyddion's readers.
#include "engine/surface/io/foreign_format.hpp"

#include <array>

#include "engine/surface/io/archive.hpp"

namespace asperity {

namespace {

using namespace std::string_view_literals;

constexpr const char* unpack = "unpack it and read the file inside";
constexpr const char* export_map =
    "export it from the instrument's software as X3P, SDF (.sdf), SUR or text, or save it as .gwy in "
    "Gwyddion";
constexpr const char* save_table = "save the sheet as CSV (UTF-8)";
constexpr const char* no_heights =
    "a picture holds colours, not heights; export the heights as X3P, SDF, SUR or text";

struct ForeignMark {
  std::string_view bytes;
  const char* what;
  const char* cure;
};

constexpr std::array foreign_marks{
    ForeignMark{"\x1F\x8B"sv, "packed with gzip (.gz)", unpack},
    ForeignMark{"BZh"sv, "packed with bzip2 (.bz2)", unpack},
    ForeignMark{"\xFD\x37zXZ\0"sv, "packed with xz (.xz)", unpack},
    ForeignMark{"\x28\xB5\x2F\xFD"sv, "packed with zstd (.zst)", unpack},
    ForeignMark{"7z\xBC\xAF\x27\x1C"sv, "a 7z archive", unpack},
    ForeignMark{"Rar!\x1A\x07"sv, "a RAR archive", unpack},
    ForeignMark{"\\*Force file list"sv, "a Nanoscope force curve", export_map},
    ForeignMark{"?*File list"sv, "a Nanoscope file of Digital Instruments (.di, .000)", export_map},
    ForeignMark{"fileType      Spectroscopy"sv, "a spectrum of Agilent or Molecular Imaging (.mi)",
                export_map},
    ForeignMark{"Zygo ASCII Data File"sv, "phases of a MetroPro map as text (Zygo ASCII)",
                "save it in MetroPro as .dat, whose head has the scale of its heights"},
    ForeignMark{"Zygo XYZ Data File"sv, "points of a MetroPro map as text (Zygo XYZ)",
                "save it in MetroPro as .dat"},
    ForeignMark{"WSxM file copyright"sv, "a WSxM file other than an image", export_map},
    ForeignMark{"Binary TrueMap Data File"sv, "a TrueMap topography (.tmd)", export_map},
    ForeignMark{"VK3_"sv, "a Keyence profilometer file (.vk3)", export_map},
    ForeignMark{"VK4_"sv, "a Keyence profilometer file (.vk4)", export_map},
    ForeignMark{"VK6"sv, "a Keyence profilometer file (.vk6)", export_map},
    ForeignMark{"VK7"sv, "a Keyence profilometer file (.vk7)", export_map},
    ForeignMark{"CDF\x01"sv, "a NetCDF file (.nc)", "write its heights as NPY or HDF5"},
    ForeignMark{"CDF\x02"sv, "a NetCDF file (.nc)", "write its heights as NPY or HDF5"},
    ForeignMark{"CDF\x05"sv, "a NetCDF file (.nc)", "write its heights as NPY or HDF5"},
    ForeignMark{"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv,
                "a compound document, such as an Excel 97 workbook (.xls) or a "
                "project of an instrument's software",
                "save the sheet as CSV (UTF-8), or the map as X3P, SDF, SUR or text"},
    ForeignMark{"\x89PNG\r\n\x1A\n"sv, "a PNG picture", no_heights},
    ForeignMark{"\xFF\xD8\xFF"sv, "a JPEG picture", no_heights},
    ForeignMark{"II*\0"sv, "a TIFF picture", no_heights},
    ForeignMark{"MM\0*"sv, "a TIFF picture", no_heights},
    ForeignMark{"%PDF-"sv, "a PDF document", "export the heights as X3P, SDF, SUR or text"},
};

struct ForeignEnding {
  std::string_view extension;
  const char* what;
};

constexpr std::array foreign_endings{
    ForeignEnding{"mnt", "a document of MountainsMap (.mnt)"},
    ForeignEnding{"stp", "a scan of Molecular Imaging (.stp)"},
    ForeignEnding{"tmd", "a TrueMap topography (.tmd)"},
};

// Packed in an unpublished layout.
bool is_mountains_document(std::string_view bytes) {
  constexpr std::string_view compound = "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv,
                             stream = "S\0c\0o\0p\0e\0d\0C\0o\0n\0t\0e\0n\0t\0s\0"sv;
  return bytes.starts_with(compound) && bytes.find(stream) != std::string_view::npos;
}

std::optional<ForeignFormat> archive_format(const SourceFile& file) {
  try {
    const Archive archive(file);
    if (archive.find("xl/workbook.xml") >= 0) return ForeignFormat{"an Excel workbook (.xlsx)", save_table};
    if (archive.find("content.xml") >= 0 && archive.find("mimetype") >= 0)
      return ForeignFormat{"an OpenDocument file (.ods)", save_table};
    if (archive.find("index.xml") >= 0 || file.extension() == "plux")
      return ForeignFormat{"a Sensofar topography (.plux)", export_map};
    return ForeignFormat{"a zip archive without main.xml", unpack};
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_file) throw;
    return {};  // cut short: the reader reports it
  }
}

}  // namespace

std::optional<ForeignFormat> foreign_format(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  if (is_mountains_document(bytes))
    return ForeignFormat{"a document of MountainsMap (.mnt)",
                         "save its studiable in MountainsMap as SUR, X3P, SDF or text"};
  for (const ForeignMark& mark : foreign_marks)
    if (bytes.starts_with(mark.bytes)) return ForeignFormat{mark.what, mark.cure};
  if (bytes.starts_with("PK\x03\x04"sv)) return archive_format(file);
  if (file.looks_like_text()) return {};
  for (const ForeignEnding& ending : foreign_endings)
    if (file.extension() == ending.extension) return ForeignFormat{ending.what, export_map};
  return {};
}

}  // namespace asperity
