// SPDX-License-Identifier: GPL-3.0-or-later
// XDMF orders axes slowest first: (z, y, x).
#include "engine/surface/io/xdmf.hpp"

#include <array>

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

// Escapes an XML attribute.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '"') {
      safe += "&quot;";
    } else {
      safe += c;
    }
  }
  return safe;
}

struct NumberType {
  const char *name, *bytes;
};

}  // namespace

std::filesystem::path xdmf_path(const std::filesystem::path& hdf5) {
  std::filesystem::path path = hdf5;
  return path.replace_extension(".xdmf");
}

bool has_xdmf_beside(const std::filesystem::path& file) {
  const std::string extension = file_extension(file.string());
  return extension == "h5" || extension == "hdf5";
}

std::string xdmf_text(const Grid& grid, std::string_view name, const Hdf5Content& content,
                      const std::filesystem::path& hdf5) {
  const std::string dimensions = "1 " + std::to_string(grid.ny) + " " + std::to_string(grid.nx);
  const auto item = [](const std::string& numbers) {
    return "        <DataItem Format=\"XML\" Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\">" +
           numbers + "</DataItem>\n";
  };
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<Xdmf Version=\"3.0\">\n"
      "  <Domain>\n"
      "    <Grid Name=\"" +
      escaped(name) +
      "\" GridType=\"Uniform\">\n"
      "      <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"" +
      dimensions +
      "\"/>\n"
      "      <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n";
  // The single layer needs any spacing except 0.
  text += item("0 0 0") +
          item(format_exact(grid.hx()) + " " + format_exact(grid.hy()) + " " + format_exact(grid.hx()));
  text += "      </Geometry>\n";
  constexpr std::array<NumberType, 3> types{{{"Float", "8"}, {"Int", "8"}, {"UChar", "1"}}};
  for (const Hdf5Array& array : content.arrays) {
    if (array.shape !=
        std::vector<std::size_t>{static_cast<std::size_t>(grid.ny), static_cast<std::size_t>(grid.nx)})
      continue;
    const NumberType type = types[array.values.index()];
    const std::string shown = array.unit.empty() ? array.name : array.name + " [" + array.unit + "]";
    text += "      <Attribute Name=\"" + escaped(shown) + "\" AttributeType=\"Scalar\" Center=\"Node\">\n" +
            "        <DataItem Format=\"HDF\" Dimensions=\"" + dimensions + "\" NumberType=\"" + type.name +
            "\" Precision=\"" + type.bytes + "\">" + escaped(hdf5.filename().string()) + ":/" +
            escaped(array.name) + "</DataItem>\n      </Attribute>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

void write_hdf5_and_xdmf(const std::filesystem::path& hdf5, const Grid& grid, std::string_view name,
                         const Hdf5Content& content) {
  write_hdf5(hdf5, content);
  AtomicFile beside(xdmf_path(hdf5), FileWords::data);
  beside.write(xdmf_text(grid, name, content, hdf5));
  beside.commit();
}

}  // namespace asperity
