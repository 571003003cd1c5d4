// SPDX-License-Identifier: GPL-3.0-or-later
// Files of three columns and two lines, built without the code under test.
#pragma once

#include "tests/surface/files.hpp"
#include "tests/surface/little_endian.hpp"

namespace asperity::testing {

struct NanoscopeImageExample {
  std::string title = "Height", line = "Trace", scan_size = "30 40 nm", sensitivity = "Sens. Zsens";
  std::string volts = "65.53600 V";
  int nx = 3, ny = 2, bytes_a_pixel = 2;
  std::string data = raw(std::vector<std::int16_t>{1, 2, 3, -4, 5, -32768});
};

inline std::string nanoscope(const std::vector<NanoscopeImageExample>& images, int version = 0x07200000) {
  constexpr std::size_t header = 4096;
  std::string text = "\\*File list\r\n\\Version: " + std::to_string(version) +
                     "\r\n\\*Scanner list\r\n\\@Sens. Zsens: V 20.00000 nm/V\r\n\\*Ciao scan list\r\n"
                     "\\@Sens. ZsensSens: V 0.4000000 \xB5m/V\r\n\\@Sens. Phase: V 1.000000 \r\n";
  std::string data;
  for (const NanoscopeImageExample& image : images) {
    text += "\\*Ciao image list\r\n\\Data offset: " + std::to_string(header + data.size()) +
            "\r\n\\Data length: " + std::to_string(image.data.size()) +
            "\r\n\\Bytes/pixel: " + std::to_string(image.bytes_a_pixel) +
            "\r\n\\Samps/line: " + std::to_string(image.nx) +
            "\r\n\\Number of lines: " + std::to_string(image.ny) + "\r\n\\Scan Size: " + image.scan_size +
            "\r\n\\Line Direction: " + image.line + "\r\n\\@2:Image Data: S [X] \"" + image.title +
            "\"\r\n\\@2:Z scale: V [" + image.sensitivity + "] (0.001000000 V/LSB) " + image.volts + "\r\n";
    data += image.data;
  }
  text += "\\*File list end\r\n\x1A";
  return Bytes().field(text, header).text(data).bytes();
}

struct NidImageExample {
  std::string name = "Z-Axis", unit = "m", range = "2e-06", least = "-1e-06", lines = "2", bits = "32",
              frame = "Scan forward";
  std::string data = raw(std::vector<std::int32_t>{0, 1, 2, -3, 4, 5});
};
inline std::string nid_example(const std::vector<NidImageExample>& images) {
  std::string head = "[DataSet]\r\nVersion=2\r\nGr0-Name=Scan forward\r\n", sections, data;
  for (std::size_t k = 0; k < images.size(); ++k) {
    const NidImageExample& image = images[k];
    const std::string name = "DataSet-0:" + std::to_string(k);
    head += "Gr0-Ch" + std::to_string(k) + "=" + name + "\r\n";
    sections +=
        "\r\n[" + name + "]\r\nPoints=3\r\nLines=" + image.lines + "\r\nFrame=" + image.frame +
        "\r\nCurLine=1\r\nDim0Unit=m\r\nDim0Range=3e-05\r\nDim1Unit=m\r\nDim1Range=4e-05\r\nDim2Name=" +
        image.name + "\r\nDim2Unit=" + image.unit + "\r\nDim2Range=" + image.range +
        "\r\nDim2Min=" + image.least + "\r\nSaveMode=Binary\r\nSaveBits=" + image.bits +
        "\r\nSaveSign=Signed\r\nSaveOrder=Intel\r\n";
    data += image.data;
  }
  return head + sections + "\r\n#!" + data;
}

// IBW version 5, single precision.
struct IbwExample {
  std::int32_t nx = 3, ny = 2, maps = 1;
  double step_x = 1e-8, step_y = 2e-8;
  std::string data_unit = "m", unit = "m", note = "a note\r";
  std::vector<std::string> labels{};
  std::int16_t type = 2;
  template <class T>
  std::string operator()(const std::vector<T>& values) const {
    const auto points = static_cast<std::uint32_t>(values.size());
    const auto label_bytes = static_cast<std::uint32_t>(labels.empty() ? 0 : 32 * (labels.size() + 1));
    Bytes b;
    b.put(std::int16_t{5}).put(std::int16_t{0}).put(static_cast<std::uint32_t>(320 + points * sizeof(T)));
    b.put(std::uint32_t{0}).put(static_cast<std::uint32_t>(note.size())).zeros(4 + 16);
    b.zeros(8).put(label_bytes).zeros(4 + 4 + 8);
    b.zeros(12).put(points).put(type).zeros(10).field("wave", 32).zeros(8);
    b.put(nx).put(ny).put(maps).put(std::int32_t{0}).put(step_x).put(step_y).put(1.0).put(1.0).zeros(32);
    b.field(data_unit, 4).field(unit, 4).field(unit, 4).zeros(8);
    b.zeros(384 - b.size()).put_all(values).text(note);
    if (!labels.empty()) {
      b.zeros(32);
      for (const std::string& label : labels) b.field(label, 32);
    }
    std::string bytes = b.bytes();
    std::uint16_t sum = 0;
    for (std::size_t k = 0; k < 384; k += 2)
      sum = static_cast<std::uint16_t>(sum + static_cast<unsigned char>(bytes[k]) +
                                       256 * static_cast<unsigned char>(bytes[k + 1]));
    sum = static_cast<std::uint16_t>(0 - sum);
    bytes[2] = static_cast<char>(sum & 0xFF);
    bytes[3] = static_cast<char>(sum >> 8);
    return bytes;
  }
};

struct MiBufferExample {
  std::string label = "Topography", unit = "um", range = "2.0000000000000000e+000", trace = "Trace";
};
inline std::string mi_example(const std::vector<MiBufferExample>& buffers, const std::string& data,
                              const std::string& kind = "BINARY", const std::string& columns = "3") {
  const auto line = [](std::string key, const std::string& value) {
    key.resize(14, ' ');
    return key + value + "\n";
  };
  std::string text = line("fileType", "Image") + line("version", "PicoView") + line("xPixels", columns) +
                     line("yPixels", "2") + line("xLength", "3.0e-005") + line("yLength", "4.0e-005") +
                     line("scanUp", "TRUE");
  for (const MiBufferExample& buffer : buffers)
    text += line("bufferLabel", buffer.label) + line("bufferRange", buffer.range) +
            line("bufferUnit", buffer.unit) + line("trace", buffer.trace);
  return text + line("data", kind) + data;
}

struct WsxmExample {
  std::string type = "double", amplitude = "5 nm", size = "30 nm", columns = "3", kind = "SxM Image file";
  std::string operator()(const std::string& data) const {
    const std::string rest =
        "\r\n\r\n[Control]\r\n\r\n    X Amplitude: " + size + "\r\n    Y Amplitude: 0.04 \xB5m\r\n\r\n" +
        "[General Info]\r\n\r\n    Image Data Type: " + type + "\r\n    Number of columns: " + columns +
        "\r\n    Number of rows: 2\r\n    Z Amplitude: " + amplitude + "\r\n\r\n[Header end]\r\n";
    const std::string start =
        "WSxM file copyright Nanotec Electronica\r\n" + kind + "\r\nImage header size: ";
    return start + std::to_string(start.size() + 3 + rest.size()) + rest + data;
  }
};

struct ParkExample {
  std::uint32_t image_type = 0, nx = 3, ny = 2, swapped = 0, number_type = 2, version = 0x01000002;
  double size_x = 3, size_y = 4, gain = -2, scale = 0, offset = 0;
  std::string unit = "nm";
  template <class T>
  std::string operator()(const std::vector<T>& values) const {
    const auto wide = [](std::string text, std::size_t characters) {
      text.resize(characters);
      std::string bytes;
      for (const char c : text) bytes += std::string{c, '\0'};
      return bytes;
    };
    Bytes h;
    h.put(image_type).text(wide("Z Height", 32)).text(wide("Tapping", 8)).put(0.0).zeros(8).put(nx).put(ny);
    h.put(0.0).zeros(4).put(0.1).zeros(8).put(swapped).put(size_x).put(size_y).zeros(32);
    h.text(wide("um", 8)).zeros(16).put(gain).put(scale).put(offset).text(wide(unit, 8)).zeros(24);
    h.zeros(16).text(wide("High", 8)).text(wide("High", 8)).text(wide("on", 8)).put(number_type);
    h.zeros(580 - h.size());
    const std::string data = raw(values);
    const std::uint32_t directory = 8, after = directory + 2 + 4 * 12 + 4;
    Bytes b;
    b.text("II*").zeros(1).put(directory).put(std::uint16_t{4});
    const auto tag = [&](std::uint16_t name, std::uint16_t type, std::size_t count, std::size_t value) {
      b.put(name).put(type).put(static_cast<std::uint32_t>(count)).put(static_cast<std::uint32_t>(value));
    };
    tag(50432, 4, 1, 0x0E031301);
    tag(50433, 4, 1, version);
    tag(50434, 1, data.size(), after);
    tag(50435, 7, h.size(), after + data.size());
    return b.zeros(4).text(data).text(h.bytes()).bytes();
  }
};

// Containers hold items.
inline std::string opdx_name(const std::string& name) {
  return Bytes().put(static_cast<std::uint32_t>(name.size())).text(name).bytes();
}
inline std::string opdx_item(const std::string& name, int type, const std::string& value) {
  return opdx_name(name) + static_cast<char>(type) + value;
}
inline std::string opdx_sized(const std::string& value) {
  return Bytes().put(std::uint8_t{4}).put(static_cast<std::uint32_t>(value.size())).text(value).bytes();
}
inline std::string opdx_container(const std::string& name, const std::string& items, int type = 0x7D) {
  return opdx_item(name, type, opdx_sized(items + opdx_item("", 0x7F, "\xFF\xFF")));
}
struct OpdxExample {
  std::string kind = "Surface Profile", unit = "um";
  double extent = 4, scale = 0.5;
  std::uint64_t points = 5;
  std::string operator()(const std::vector<double>& values) const {
    const auto quantity = [&](double value) {
      return opdx_sized(
          Bytes().put(value).text(opdx_name("Micrometer")).text(opdx_name(unit)).zeros(20).bytes());
    };
    const std::string array = Bytes().put(std::uint8_t{13}).put(std::uint32_t{8}).put_all(values).bytes();
    const std::string raw_data = opdx_item("ValueTypeName", 0x12, opdx_sized("double")) +
                                 opdx_item("Extent", 0x13, quantity(extent)) +
                                 opdx_item("NumPoints", 0x0B, Bytes().put(points).bytes()) +
                                 opdx_item("DataScale", 0x13, quantity(scale)) +
                                 opdx_item("Array", 0x40, opdx_name("double *") + opdx_sized(array));
    const std::string meta =
        opdx_item("DataKind", 0x12, opdx_sized(kind)) + opdx_item("Valid", 0x01, "\x01") +
        opdx_container("1D_Channels", opdx_item("Height", 0x42,
                                                opdx_name("vector<wstring>") + opdx_sized(opdx_name("Raw"))));
    return std::string("VCA DATA\x01\0\0\x55", 12) +
           opdx_container("1D_Data", opdx_container("Raw", raw_data, 0x46)) +
           opdx_container("MetaData", meta) + opdx_item("", 0x7F, "\xFF\xFF");
  }
};

}  // namespace asperity::testing
