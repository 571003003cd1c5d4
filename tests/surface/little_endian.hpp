// SPDX-License-Identifier: GPL-3.0-or-later
// Instrument files built from published layouts, without the code under test.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::testing {

class Bytes {
 public:
  template <class T>
  Bytes& put(T value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  template <class T>
  Bytes& put_all(const std::vector<T>& values) {
    for (const T value : values) put(value);
    return *this;
  }
  Bytes& text(std::string_view text) {
    text_ += text;
    return *this;
  }
  Bytes& field(std::string_view text, std::size_t width, char pad = '\0') {
    text_ += text;
    text_.append(width - text.size(), pad);
    return *this;
  }
  Bytes& zeros(std::size_t count) {
    text_.append(count, '\0');
    return *this;
  }
  const std::string& bytes() const { return text_; }
  std::size_t size() const { return text_.size(); }

 private:
  std::string text_;
};

// SDF, ISO 25178-71, binary.
struct SdfExample {
  std::string version = "bISO-1.0";
  std::uint16_t points = 3, profiles = 2;
  double x_scale = 1e-6, y_scale = 2e-6, z_scale = 1e-9;
  std::uint8_t compression = 0, type = 7;
  template <class T>
  std::string operator()(const std::vector<T>& heights) const {
    Bytes b;
    b.text(version)
        .field("maker", 10, ' ')
        .text("010120261200")
        .text("010120261200")
        .put(points)
        .put(profiles);
    b.put(x_scale).put(y_scale).put(z_scale).put(-1.0).put(compression).put(type).put(std::uint8_t{0});
    return b.put_all(heights).bytes();
  }
};

struct SurExample {
  std::string mark = "DIGITAL SURF";
  std::int16_t order = 0, objects = 1, type = 2, special = 0, bits = 16;
  std::int32_t least = 0, most = 0, nx = 3, ny = 2;
  float dx = 1, dy = 2, dz = 0.5, offset = 0;
  std::string unit_xy = "um", unit_z = "nm", comment{}, own{};
  template <class T>
  std::string operator()(const std::vector<T>& heights) const {
    Bytes b;
    b.text(mark).put(order).put(objects).put(std::int16_t{1}).put(type).field("object", 30, ' ');
    b.field("operator", 30, ' ').put(std::int16_t{0}).put(std::int16_t{0}).put(std::int16_t{0}).put(special);
    b.put(std::int16_t{0}).zeros(8).put(bits).put(least).put(most).put(nx).put(ny);
    b.put(static_cast<std::int32_t>(std::int64_t{nx} * ny));  // the low bits only
    b.put(dx).put(dy).put(dz).field("X", 16, ' ').field("Y", 16, ' ').field("Z", 16, ' ');
    for (int k = 0; k < 2; ++k) b.field(unit_xy, 16).field(unit_xy, 16).field(unit_z, 16);
    b.put(1.0F).put(1.0F).put(1.0F).zeros(3 * 2 + 12 + 7 * 2 + 4 + 10);
    b.put(static_cast<std::uint16_t>(comment.size())).put(static_cast<std::uint16_t>(own.size())).zeros(128);
    b.put(0.0F).put(0.0F).put(offset);
    b.zeros(512 - b.size()).text(comment).text(own);
    return b.put_all(heights).bytes();
  }
};

struct OpdBlock {
  std::string name;
  std::int16_t type;
  std::string data;
};
inline std::string opd_example(const std::vector<OpdBlock>& blocks) {
  Bytes b;
  const auto entry = [&](const std::string& name, std::int16_t type, std::size_t size) {
    b.field(name, 16).put(type).put(static_cast<std::uint32_t>(size)).put(std::uint16_t{0xFFFF});
  };
  b.put(std::uint16_t{1});
  entry("Directory", 1, 24 * (blocks.size() + 1));
  for (const OpdBlock& block : blocks) entry(block.name, block.type, block.data.size());
  for (const OpdBlock& block : blocks) b.text(block.data);
  return b.bytes();
}
template <class T>
OpdBlock opd_map(const std::string& name, std::uint16_t nx, std::uint16_t ny, const std::vector<T>& columns) {
  Bytes b;
  b.put(nx).put(ny).put(static_cast<std::uint16_t>(sizeof(T))).put_all(columns);
  return {name, 3, b.bytes()};
}
inline OpdBlock opd_number(const std::string& name, float value) {
  return {name, 7, Bytes().put(value).bytes()};
}

inline std::string gwy_text(std::string_view name, std::string_view value) {
  return Bytes().text(name).zeros(1).text("s").text(value).zeros(1).bytes();
}
inline std::string gwy_object(std::string_view name, std::string_view content) {
  return Bytes().text(name).zeros(1).put(static_cast<std::uint32_t>(content.size())).text(content).bytes();
}
inline std::string gwy_inner(std::string_view key, std::string_view object) {
  return Bytes().text(key).zeros(1).text("o").text(object).bytes();
}
struct GwyField {
  std::int32_t nx = 3, ny = 2;
  double size_x = 3e-6, size_y = 4e-6;
  std::string unit_xy = "m", unit_z = "m";
  std::vector<double> heights = {1e-9, 2e-9, 3e-9, 4e-9, 5e-9, 6e-9};
  std::string object() const {
    Bytes b;
    b.text("xres").zeros(1).text("i").put(nx).text("yres").zeros(1).text("i").put(ny);
    b.text("xreal").zeros(1).text("d").put(size_x).text("yreal").zeros(1).text("d").put(size_y);
    b.text("xoff").zeros(1).text("d").put(1e-3);
    b.text(gwy_inner("si_unit_xy", gwy_object("GwySIUnit", gwy_text("unitstr", unit_xy))));
    b.text(gwy_inner("si_unit_z", gwy_object("GwySIUnit", gwy_text("unitstr", unit_z))));
    b.text("data").zeros(1).text("D").put(static_cast<std::uint32_t>(heights.size())).put_all(heights);
    return gwy_object("GwyDataField", b.bytes());
  }
};
inline std::string gwy_example(const std::string& content) {
  return "GWYP" + gwy_object("GwyContainer", content);
}

}  // namespace asperity::testing
