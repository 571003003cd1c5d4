// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/hdf5_reader/hdf5_data.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "engine/core/text.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_chunks.hpp"

namespace asperity {

namespace {

template <class T>
T element(const char* at, bool swap) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), at, sizeof(T));
  if (swap) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

template <class From, class To>
Array<To> converted(std::string_view raw, bool swap, Monitor& monitor) {
  Array<To> values(raw.size() / sizeof(From));
  constexpr std::size_t piece = std::size_t{1} << 16;
  Task task(monitor, "reading", static_cast<std::int64_t>(values.size() / piece + 1));
  for (std::size_t start = 0; start < values.size(); start += piece) {
    const std::size_t end = std::min(values.size(), start + piece);
    if (std::is_same_v<From, To> && !swap) {
      std::memcpy(values.data() + start, raw.data() + start * sizeof(From), (end - start) * sizeof(From));
    } else {
      for (std::size_t k = start; k < end; ++k)
        values[k] = static_cast<To>(element<From>(raw.data() + k * sizeof(From), swap));
    }
    task.advance();
  }
  return values;
}

Array<std::int64_t> wide_integers(const Hdf5Type& type, std::string_view raw, bool swap, Monitor& monitor) {
  switch (type.width) {
    case 1:
      return converted<std::int8_t, std::int64_t>(raw, swap, monitor);
    case 2:
      return type.is_signed ? converted<std::int16_t, std::int64_t>(raw, swap, monitor)
                            : converted<std::uint16_t, std::int64_t>(raw, swap, monitor);
    case 4:
      return type.is_signed ? converted<std::int32_t, std::int64_t>(raw, swap, monitor)
                            : converted<std::uint32_t, std::int64_t>(raw, swap, monitor);
    default:
      return converted<std::int64_t, std::int64_t>(raw, swap, monitor);
  }
}

Hdf5Array from_raw(const Hdf5Dataset& dataset, std::string_view raw, Monitor& monitor) {
  std::vector<std::size_t> shape(dataset.shape.sizes.begin(), dataset.shape.sizes.end());
  if (dataset.shape.none) shape = {0};
  const Hdf5Type& type = dataset.type;
  const bool swap = type.big_endian == (std::endian::native == std::endian::little);
  const auto owning = [&](auto values) {
    return owning_array(dataset.name, std::move(shape), std::move(values));
  };
  if (type.kind == Hdf5Type::Kind::floating)
    return owning(type.width == 8 ? converted<double, double>(raw, swap, monitor)
                                  : converted<float, double>(raw, swap, monitor));
  if (type.width == 1 && !type.is_signed)
    return owning(converted<std::uint8_t, std::uint8_t>(raw, swap, monitor));
  Array<std::int64_t> values = wide_integers(type, raw, swap, monitor);
  // Those past int64 would have a wrong sign.
  if (type.width == 8 && !type.is_signed &&
      std::any_of(values.begin(), values.end(), [](std::int64_t value) { return value < 0; }))
    return owning(converted<std::uint64_t, double>(raw, swap, monitor));
  return owning(std::move(values));
}

bool is_empty(const Hdf5Shape& shape) {
  return shape.none || std::find(shape.sizes.begin(), shape.sizes.end(), 0) != shape.sizes.end();
}

}  // namespace

std::string why_unread(const Hdf5Dataset& dataset) {
  if (dataset.type.kind != Hdf5Type::Kind::floating && dataset.type.kind != Hdf5Type::Kind::integer)
    return dataset.type.word;
  if (dataset.layout.kind == Hdf5Layout::Kind::other)
    return "numbers in a layout that is not known (h5repack --layout=CONTI writes one that is)";
  if (dataset.layout.nowhere && !is_empty(dataset.shape)) return "numbers that were never written";
  if (dataset.layout.kind == Hdf5Layout::Kind::chunked) return why_chunks_unread(dataset);
  return {};
}

Hdf5Array read_numbers(const Hdf5Bytes& file, const Hdf5Dataset& dataset, std::uint64_t& room,
                       Monitor& monitor) {
  const std::uint64_t bytes = dataset.shape.count(file) * dataset.type.width;
  if (dataset.layout.kind == Hdf5Layout::Kind::chunked && bytes > 0) {
    const Array<char> raw = read_chunks(file, dataset, room, monitor);
    return from_raw(dataset, {raw.data(), raw.size()}, monitor);
  }
  if (bytes > room)
    file.refuse("is damaged: it claims " + std::to_string(bytes) + " bytes of numbers in " +
                    quoted(dataset.name) + ", more than are left of the file",
                "the file is cut short or altered");
  room -= bytes;
  if (dataset.layout.kind == Hdf5Layout::Kind::compact) {
    if (dataset.layout.compact.size() < bytes)
      file.refuse("is damaged: " + quoted(dataset.name) + " has fewer numbers than its shape");
    return from_raw(dataset, dataset.layout.compact.substr(0, bytes), monitor);
  }
  if (bytes == 0) return from_raw(dataset, {}, monitor);
  if (dataset.layout.length < bytes)
    file.refuse("is damaged: " + quoted(dataset.name) + " has fewer numbers than its shape");
  return from_raw(dataset, file.piece(dataset.layout.address, bytes, "an array"), monitor);
}

}  // namespace asperity
