// SPDX-License-Identifier: GPL-3.0-or-later
// NID of Nanosurf's microscopes: header sections `[Name]` of lines `key=value`, then `#!` and the numbers of
// all images in the order of [DataSet]. A number n of b bits has height (n / 2^b + 1/2) · `Dim2Range` +
// `Dim2Min`. No missing points. Layout: the headers, and Gwyddion's reader of EZD.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view nid_mark = "[DataSet]", nid_data_mark = "#!";

struct NidHeader {
  std::map<std::string, HeaderEntries> sections;
  std::vector<std::string> images;  // in the order of the data
  std::string_view data;
};

NidHeader nid_header(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  const std::size_t end = bytes.find("\n#!");
  if (end == std::string_view::npos)
    refuse_file(file, "has no data: no line in it starts with #!", "the file is cut short");
  NidHeader header;
  header.data = bytes.substr(end + 1 + nid_data_mark.size());
  LineReader reader(bytes.substr(0, end));
  std::string_view line;
  HeaderEntries* section = nullptr;
  std::string name;
  while (reader.next(line)) {
    line = trimmed(line);
    if (line.starts_with('[') && line.ends_with(']')) {
      name = line.substr(1, line.size() - 2);
      section = &header.sections.try_emplace(name, file).first->second;
      continue;
    }
    const std::size_t sign = line.find('=');
    if (sign == std::string_view::npos || section == nullptr) continue;
    const std::string_view key = trimmed(line.substr(0, sign)), value = trimmed(line.substr(sign + 1));
    section->add(key, value);
    if (name == "DataSet" && key.starts_with("Gr") && key.find("-Ch") != std::string_view::npos)
      header.images.emplace_back(value);
  }
  return header;
}

struct NidImage {
  const HeaderEntries* section = nullptr;
  std::uint64_t nx = 0, ny = 0, width = 0;
  std::string_view data;
};

NidImage take_nid_image(const SourceFile& file, const NidHeader& header, const std::string& name,
                        std::string_view& data) {
  const auto found = header.sections.find(name);
  if (found == header.sections.end())
    refuse_file(file, "names an image " + shown(name) + ", and its header does not describe it");
  NidImage image;
  const HeaderEntries& section = found->second;
  image.section = &section;
  image.nx = section.count("Points");
  image.ny = section.count("Lines");
  const std::uint64_t bits = section.count("SaveBits");
  const auto is = [&](const char* key, std::string_view wanted) {
    return section.find(key).value_or(wanted) == wanted;
  };
  if ((bits != 16 && bits != 32) || !is("SaveMode", "Binary") || !is("SaveSign", "Signed") ||
      !is("SaveOrder", "Intel"))
    refuse_file(file, "has an image " + shown(name) + " whose numbers are not as usual",
                "signed binary integers of 16 and 32 bits in Intel's order are read");
  image.width = bits / 8;
  require_numbers(file, image.nx, image.ny, image.width, data.size());
  image.data = data.substr(0, image.nx * image.ny * image.width);
  data.remove_prefix(image.data.size());
  return image;
}

HeightMap read_nid_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  const NidHeader header = nid_header(file);
  std::vector<NidImage> images;
  std::vector<NamedMap> maps;
  std::string_view data = header.data;
  for (const std::string& name : header.images) {
    images.push_back(take_nid_image(file, header, name, data));
    const HeaderEntries& section = *images.back().section;
    const std::string title = plain_text(std::string(section.text("Dim2Name")));
    const auto frame = section.find("Frame");
    const bool length = instrument_length_unit(section.text("Dim2Unit")).has_value();
    maps.push_back({frame ? title + ", " + plain_text(std::string(*frame)) : title,
                    length && (title.starts_with("Z-Axis") || title.starts_with("Topography"))});
  }
  if (!data.empty())
    refuse_file(file, "has " + std::to_string(data.size()) + " bytes after its last image",
                "its header is wrong or the file is damaged");
  tell_apart(maps);
  const std::size_t found = chosen_map(file, maps, channel);
  const NidImage& image = images[found];
  const HeaderEntries& section = *image.section;
  const std::string_view unit_text = section.text("Dim2Unit");
  const std::optional<double> unit = instrument_length_unit(unit_text);
  if (!unit) refuse_no_heights(file, maps[found], shown(unit_text));
  const double range = above_zero(file, section.number("Dim2Range"), "as its Dim2Range");
  const double least = section.number("Dim2Min");
  HeightMap map;
  const double steps = image.width == 2 ? 65536.0 : 4294967296.0;
  map.heights = field_of_numbers(image.width == 2 ? number_type<std::int16_t> : number_type<std::int32_t>,
                                 image.data, image.nx, image.ny, monitor);
  for (double& height : map.heights.values()) height = (height / steps + 0.5) * range + least;
  map.unit = unit;
  map.size_x = section.length("Dim0Range", section.text("Dim0Unit"));
  map.size_y = section.length("Dim1Range", section.text("Dim1Unit"));
  map.trace = image.ny == 1;
  if (section.find("CurLine"))
    if (const std::uint64_t last = section.count("CurLine"); last + 1 < image.ny)
      monitor.warn(file_name(file.path()) + " says that its scan stopped at line " +
                   std::to_string(last + 1) + " of " + std::to_string(image.ny) +
                   ": crop it to the measured lines");
  return map;
}

bool recognises_nid(const SourceFile& file) {
  return file.bytes().starts_with(nid_mark) && file.bytes().find("\n#!") != std::string_view::npos;
}

}  // namespace

extern constexpr Format nid_format{
    "nid",
    "[DataSet] at the start",
    {"NID of Nanosurf's microscopes: the image of the z axis, or another in a unit of length with "
     "`channel`.",
     "Images of other quantities, numbers of other than 16 and 32 bits.",
     "A file of the public test set of SurfaceTopography: heights and sizes, by an independent program."},
    {FirstLine::bottom, "Gwyddion's reader of the same layout (EZD) shows the first line at the bottom."},
    {"nid"},
    recognises_nid,
    nullptr,
    read_nid_channel,
    true};

}  // namespace asperity
