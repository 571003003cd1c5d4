// SPDX-License-Identifier: GPL-3.0-or-later
// Optical instruments' files from published layouts, without the code under test; zlib compression.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/surface/little_endian.hpp"

namespace asperity::testing {

// window 16 + bits: gzip; otherwise zlib.
inline std::string deflated_as(std::string_view plain, int window) {
  z_stream stream{};
  if (deflateInit2(&stream, 9, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY) != Z_OK) return {};
  std::string packed(deflateBound(&stream, plain.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
  stream.avail_in = static_cast<uInt>(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}
inline std::string gzipped(std::string_view plain) { return deflated_as(plain, MAX_WBITS + 16); }
inline std::string zlib_packed(std::string_view plain) { return deflated_as(plain, MAX_WBITS); }

// Lengths of the pieces, then the pieces.
inline std::string sur_pieces(const std::vector<std::string>& plain) {
  Bytes b;
  b.put(static_cast<std::uint32_t>(plain.size()));
  for (const std::string& piece : plain)
    b.put(static_cast<std::uint32_t>(piece.size()))
        .put(static_cast<std::uint32_t>(zlib_packed(piece).size()));
  for (const std::string& piece : plain) b.text(zlib_packed(piece));
  return b.bytes();
}

template <class T>
std::string big(T value) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

struct MetroProExample {
  std::string mark = "\x88\x1B\x03\x6F";
  std::uint16_t version = 1, nx = 3, ny = 2, picture_nx = 2, picture_ny = 1, pictures = 1;
  std::uint32_t header = 834, picture_bytes = 4;
  float scale = 0.5F, wavelength = 512e-9F, obliquity = 1, spacing = 1e-6F;
  std::int16_t resolution = 0, inverted = 0;
  std::string operator()(const std::vector<std::int32_t>& phases) const {
    std::string bytes(header, '\0');
    const auto put = [&](std::size_t at, const std::string& what) { bytes.replace(at, what.size(), what); };
    put(0, mark);
    put(4, big(version));
    put(6, big(header));
    put(52, big(picture_nx) + big(picture_ny) + big(pictures));
    put(60, big(picture_bytes));
    put(68, big(nx) + big(ny));
    put(164, big(scale) + big(wavelength));
    put(176, big(obliquity));
    put(184, big(spacing));
    put(218, big(resolution));
    put(232, big(inverted));
    bytes.append(picture_bytes, '\x07');
    for (const std::int32_t phase : phases) bytes += big(phase);
    return bytes;
  }
};

struct PluExample {
  std::string date = "Fri Mar 10 16:35:59 2023";
  std::uint32_t nx = 3, ny = 2, type = 3, layer_nx = 3, layer_ny = 2;
  float dx = 2, dy = 4;
  std::uint8_t layers = 1;
  std::string operator()(const std::vector<float>& heights) const {
    Bytes b;
    b.field(date, 128).put(std::uint32_t{1}).field("a comment", 256);
    b.put(ny).put(nx).put(nx).put(1.0F).put(dx).put(dy).put(5.0F).put(6.0F).put(1.0F).put(7.0F);
    b.put(type).zeros(16).zeros(40).put(std::uint8_t{0}).put(layers).zeros(10);
    return b.put(layer_ny).put(layer_nx).put_all(heights).put(-1.0F).put(1.0F).bytes();
  }
};

// `pad` bytes follow each line.
struct Al3dExample {
  std::vector<std::pair<std::string, std::string>> tags{{"Cols", "4"},
                                                        {"Rows", "2"},
                                                        {"NumberOfPlanes", "0"},
                                                        {"PixelSizeXMeter", "1e-06"},
                                                        {"PixelSizeYMeter", "2e-06"},
                                                        {"InvalidPixelValue", "3.00000002e+15"}};
  int pad = 0;
  std::string after{};
  std::string operator()(const std::vector<std::vector<float>>& lines) const {
    Bytes b;
    b.text(std::string_view("AliconaImaging\0\r\n", 17));
    const auto tag = [&](const std::string& name, const std::string& value) {
      b.field(name, 20).field(value, 30).text("\r\n");
    };
    tag("Version", "1");
    tag("TagCount", std::to_string(tags.size() + 1));
    for (const auto& [name, value] : tags) tag(name, value);
    tag("DepthImageOffset", std::to_string(b.size() + 52));
    for (const std::vector<float>& line : lines) b.put_all(line).zeros(static_cast<std::size_t>(pad));
    return b.text(after).bytes();
  }
};

struct NmsExample {
  std::uint32_t first = 0, last = 65535, header = 1500, width = 2, nx = 3, ny = 2;
  double low = -1, high = 1, dx = 100, dy = 200;
  bool picture = true;
  std::string operator()(const std::vector<std::uint16_t>& heights) const {
    Bytes b;
    b.put(std::uint32_t{2}).put(std::uint32_t{1}).put(first).put(last).put(low).put(high);
    b.field("OM_MS_2.0", 20).field("Confocal Height Image", 24);
    b.zeros(1352 - b.size()).put(header).put(width).zeros(8).put(nx).put(ny).put(dx).put(dy);
    b.zeros(1500 - b.size()).put_all(heights);
    return picture ? b.zeros(heights.size()).bytes() : b.bytes();
  }
};

struct FrtBlock {
  int kind;
  std::string content;
};
inline std::string frt_example(const std::vector<FrtBlock>& blocks, const std::string& version = "1.00") {
  Bytes b;
  b.text("FRTM_GLIDERV" + version).put(static_cast<std::uint16_t>(blocks.size()));
  for (const FrtBlock& block : blocks) {
    b.put(static_cast<std::uint16_t>(block.kind));
    if (version == "1.00")
      b.put(static_cast<std::uint32_t>(block.content.size()));
    else
      b.put(static_cast<std::uint64_t>(block.content.size()));
    b.text(block.content);
  }
  return b.bytes();
}
inline FrtBlock frt_shape(std::uint32_t nx, std::uint32_t ny, std::uint32_t bits) {
  return {0x66, Bytes().put(nx).put(ny).put(bits).bytes()};
}
inline FrtBlock frt_size(double x, double y) { return {0x67, Bytes().put(x).put(y).zeros(28).bytes()}; }
inline FrtBlock frt_scale(double step) { return {0x6C, Bytes().put(std::uint32_t{1}).put(step).bytes()}; }
template <class T>
FrtBlock frt_heights(const std::vector<T>& heights) {
  return {0x0B, Bytes().put_all(heights).bytes()};
}

}  // namespace asperity::testing
