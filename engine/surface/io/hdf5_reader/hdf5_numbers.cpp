// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a dataset: contiguous or chunked (B-tree version 1); deflate, shuffle, fletcher32; any width
// and byte order.
#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/core/text.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_objects.hpp"

namespace asperity {

namespace {

// Bytes of equal significance are stored together.
Array<char> unshuffled(const Array<char>& mixed, std::size_t width) {
  Array<char> plain(mixed);
  const std::size_t count = mixed.size() / width;
  for (std::size_t byte = 0; byte < width; ++byte)
    for (std::size_t k = 0; k < count; ++k) plain[k * width + byte] = mixed[byte * count + k];
  return plain;
}

// Fletcher's checksum of big-endian 16-bit words, modulo 65535.
std::uint32_t fletcher32(std::string_view bytes) {
  std::uint64_t first = 0, second = 0;
  for (std::size_t k = 0; k < bytes.size(); k += 2) {
    const auto high = static_cast<unsigned char>(bytes[k]);
    const auto low = k + 1 < bytes.size() ? static_cast<unsigned char>(bytes[k + 1]) : std::uint8_t{0};
    first = (first + (std::uint64_t{high} << 8 | low)) % 65535;
    second = (second + first) % 65535;
  }
  return static_cast<std::uint32_t>(second << 16 | first);
}

class Chunks {
 public:
  Chunks(const Hdf5Bytes& file, const Hdf5Dataset& dataset, std::uint64_t& room)
      : file_(file),
        dataset_(dataset),
        room_(room),
        rank_(dataset.shape.sizes.size()),
        width_(dataset.type.width) {
    const std::string& name = dataset.name;
    const std::vector<std::uint64_t>& chunk = dataset.layout.chunk;
    if (rank_ == 0 || chunk.size() != rank_ + 1 || chunk.back() != width_)
      file.damaged("the chunks of " + quoted(name) + " are not those of its numbers");
    // Each chunk needs more than 16 bytes of the file.
    const std::uint64_t size = file.bytes.size(), most = size / 16 + 1;
    std::uint64_t count = 1;
    chunk_bytes_ = width_;
    for (std::size_t k = 0; k < rank_; ++k) {
      if (chunk[k] == 0) file.damaged(quoted(name) + " has chunks of nothing");
      along_.push_back((dataset.shape.sizes[k] - 1) / chunk[k] + 1);
      if (along_[k] > most / count || chunk[k] > size * most_of_deflate / chunk_bytes_)
        file.damaged("it claims more numbers in " + quoted(name) + " than it can hold");
      count *= along_[k];
      chunk_bytes_ *= chunk[k];
    }
    found_.resize(count);
    if (dataset.shape.count(file) * width_ > size * most_of_deflate)
      file.damaged("it claims more numbers in " + quoted(name) + " than it can hold");
  }

  // In C order.
  Array<char> read(Monitor& monitor) {
    Task task(monitor, "reading", static_cast<std::int64_t>(found_.size()));
    walk(dataset_.layout.address, 0, task);
    if (std::ranges::find(found_, 0) != found_.end())
      refuse_file(file_.file,
                  "holds " + quoted(dataset_.name) + ", and some of its numbers were never written",
                  "write them all");
    return std::move(values_);
  }

 private:
  void walk(std::uint64_t node, int depth, Task& task) {
    constexpr const char* what = "a tree of chunks";
    constexpr int deepest = 16;
    if (depth > deepest || ++nodes_ > file_.bytes.size() / 24)
      file_.damaged("a tree of chunks goes round in circles");
    const std::uint64_t head_bytes = 8 + 2 * file_.address_width;
    Hdf5Cursor head(file_, node, head_bytes, what);
    if (!head.starts_with("TREE") || head.number(1) != 1) head.refuse("has no mark");
    const std::uint64_t level = head.number(1), count = head.number(2);
    Hdf5Cursor cursor(file_, node + head_bytes, count * (8 + 8 * (rank_ + 1) + file_.address_width), what);
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::uint64_t length = cursor.number(4), skipped = cursor.number(4);
      std::vector<std::uint64_t> place;
      for (std::size_t side = 0; side <= rank_; ++side) place.push_back(cursor.number(8));
      const std::uint64_t child = cursor.address();
      if (level > 0) {
        walk(child, depth + 1, task);
      } else {
        put(place, plain(file_.piece(child, length, "a chunk"), skipped));
        task.advance();
      }
    }
  }

  // Undoes the filters, last first.
  Array<char> plain(std::string_view stored, std::uint64_t skipped) {
    const std::string& name = dataset_.name;
    if (stored.size() > room_) file_.damaged("chunks of " + quoted(name) + " overlap");
    room_ -= stored.size();
    Array<char> bytes(stored.begin(), stored.end());
    const std::vector<std::uint64_t>& filters = dataset_.filters;
    for (std::size_t k = filters.size(); k-- > 0;) {
      constexpr std::size_t sum = 4;
      if (k < 32 && (skipped >> k & 1) != 0) continue;
      if (filters[k] == Hdf5Filter::fletcher32) {
        if (bytes.size() < sum) file_.damaged("a chunk is shorter than its checksum");
        const std::string_view content(bytes.data(), bytes.size() - sum);
        if (Hdf5Cursor(file_, {content.end(), sum}, "").number(sum) != fletcher32(content))
          file_.damaged("the checksum of a chunk of " + quoted(name) + " is not that of its bytes");
        bytes.resize(content.size());
      } else if (filters[k] == Hdf5Filter::deflate) {
        // Includes a checksum made before compression.
        const auto here = filters.begin() + static_cast<std::ptrdiff_t>(k);
        const bool summed = std::find(filters.begin(), here, Hdf5Filter::fletcher32) != here;
        bytes = inflated(file_.file, {bytes.data(), bytes.size()}, chunk_bytes_ + (summed ? sum : 0),
                         "a chunk of " + quoted(name));
      } else {
        bytes = unshuffled(bytes, width_);
      }
    }
    if (bytes.size() != chunk_bytes_) file_.damaged("a chunk of " + quoted(name) + " is not of its size");
    return bytes;
  }

  void put(const std::vector<std::uint64_t>& place, const Array<char>& bytes) {
    const std::vector<std::uint64_t>& sizes = dataset_.shape.sizes;
    const std::vector<std::uint64_t>& chunk = dataset_.layout.chunk;
    std::uint64_t index = 0, rows = 1;
    std::vector<std::uint64_t> inside;  // position in the array
    for (std::size_t k = 0; k < rank_; ++k) {
      if (place[k] >= sizes[k] || place[k] % chunk[k] != 0)
        file_.damaged("a chunk of " + quoted(dataset_.name) + " is outside it");
      index = index * along_[k] + place[k] / chunk[k];
      inside.push_back(std::min(chunk[k], sizes[k] - place[k]));
      if (k + 1 < rank_) rows *= inside[k];
    }
    if (found_[index] != 0) file_.damaged("a chunk of " + quoted(dataset_.name) + " is there twice");
    found_[index] = 1;
    // Allocated once the first chunk has its claimed size.
    if (values_.empty()) values_.resize(dataset_.shape.count(file_) * width_);
    const std::size_t last = rank_ - 1;
    std::vector<std::uint64_t> at(last, 0);  // row in the chunk
    while (rows-- > 0) {
      std::uint64_t from = 0, to = 0;
      for (std::size_t k = 0; k < last; ++k) {
        from = from * chunk[k] + at[k];
        to = to * sizes[k] + place[k] + at[k];
      }
      std::memcpy(values_.data() + (to * sizes[last] + place[last]) * width_,
                  bytes.data() + from * chunk[last] * width_, inside[last] * width_);
      for (std::size_t k = last; k-- > 0 && ++at[k] == inside[k];) at[k] = 0;
    }
  }

  const Hdf5Bytes& file_;
  const Hdf5Dataset& dataset_;
  std::uint64_t& room_;
  std::size_t rank_, width_;
  std::uint64_t chunk_bytes_ = 0;
  std::vector<std::uint64_t> along_;  // per side
  Array<std::uint8_t> found_;
  Array<char> values_;
  std::size_t nodes_ = 0;
};

template <class From, class To>
Array<To> converted(std::string_view raw, bool swap, Monitor& monitor) {
  Array<To> values(raw.size() / sizeof(From));
  const auto read = swap ? big_endian<From> : little_endian<From>;
  constexpr std::size_t piece = std::size_t{1} << 16;
  Task task(monitor, "reading", static_cast<std::int64_t>(values.size() / piece + 1));
  for (std::size_t start = 0; start < values.size(); start += piece) {
    const std::size_t end = std::min(values.size(), start + piece);
    if (std::is_same_v<From, To> && !swap) {
      std::memcpy(values.data() + start, raw.data() + start * sizeof(From), (end - start) * sizeof(From));
    } else {
      for (std::size_t k = start; k < end; ++k)
        values[k] = static_cast<To>(read(raw.data() + k * sizeof(From)));
    }
    task.advance();
  }
  return values;
}

Array<std::int64_t> wide_integers(const Hdf5Type& type, std::string_view raw, bool swap, Monitor& monitor) {
  const auto of = [&](auto zero) { return converted<decltype(zero), std::int64_t>(raw, swap, monitor); };
  if (type.width == 1) return of(std::int8_t{});
  if (type.width == 2) return type.is_signed ? of(std::int16_t{}) : of(std::uint16_t{});
  if (type.width == 4) return type.is_signed ? of(std::int32_t{}) : of(std::uint32_t{});
  return of(std::int64_t{});
}

// In C order.
Hdf5Array from_raw(const Hdf5Dataset& dataset, std::string_view raw, Monitor& monitor) {
  std::vector<std::size_t> shape(dataset.shape.sizes.begin(), dataset.shape.sizes.end());
  if (dataset.shape.none) shape = {0};
  const Hdf5Type& type = dataset.type;
  const bool swap = type.big_endian;
  const auto owning = [&](auto values) {
    return owning_array(dataset.name, std::move(shape), std::move(values));
  };
  if (type.kind == Hdf5Type::Kind::floating)
    return owning(type.width == 8 ? converted<double, double>(raw, swap, monitor)
                                  : converted<float, double>(raw, swap, monitor));
  if (type.width == 1 && !type.is_signed)
    return owning(converted<std::uint8_t, std::uint8_t>(raw, swap, monitor));
  Array<std::int64_t> values = wide_integers(type, raw, swap, monitor);
  // Would have a wrong sign.
  if (type.width == 8 && !type.is_signed && std::ranges::any_of(values, [](auto value) { return value < 0; }))
    return owning(converted<std::uint64_t, double>(raw, swap, monitor));
  return owning(std::move(values));
}

}  // namespace

std::string why_unread(const Hdf5Dataset& dataset) {
  const Hdf5Layout& layout = dataset.layout;
  if (!dataset.type.is_number()) return dataset.type.word;
  if (layout.kind == Hdf5Layout::Kind::other)
    return "numbers in a layout that is not known (h5repack --layout=CONTI writes one that is)";
  if (layout.nowhere && !dataset.shape.is_empty()) return "numbers that were never written";
  if (layout.kind == Hdf5Layout::Kind::chunked)
    for (const std::uint64_t filter : dataset.filters)
      if (filter < Hdf5Filter::deflate || filter > Hdf5Filter::fletcher32)
        return "numbers compressed by the filter " + std::to_string(filter) +
               " (deflate and shuffle are read)";
  return {};
}

Hdf5Array read_numbers(const Hdf5Bytes& file, const Hdf5Dataset& dataset, std::uint64_t& room,
                       Monitor& monitor) {
  const Hdf5Layout& layout = dataset.layout;
  const std::uint64_t bytes = dataset.shape.count(file) * dataset.type.width;
  if (layout.kind == Hdf5Layout::Kind::chunked && bytes > 0) {
    const Array<char> raw = Chunks(file, dataset, room).read(monitor);
    return from_raw(dataset, {raw.data(), raw.size()}, monitor);
  }
  if (bytes > room)
    file.damaged("it claims " + std::to_string(bytes) + " bytes of numbers in " + quoted(dataset.name) +
                     ", more than are left of the file",
                 "the file is cut short or altered");
  room -= bytes;
  if (bytes == 0) return from_raw(dataset, {}, monitor);
  const bool compact = layout.kind == Hdf5Layout::Kind::compact;
  if ((compact ? layout.compact.size() : layout.length) < bytes)
    file.damaged(quoted(dataset.name) + " has fewer numbers than its shape");
  return from_raw(dataset,
                  compact ? layout.compact.substr(0, bytes) : file.piece(layout.address, bytes, "an array"),
                  monitor);
}

std::optional<double> number_of(const Hdf5Bytes& file, const Hdf5Attribute& attribute) {
  const Hdf5Type& type = attribute.type;
  if (!type.is_number() || attribute.shape.count(file) != 1) return {};
  Hdf5Cursor cursor(file, attribute.data, "the number of an attribute");
  const Hdf5Array one =
      from_raw({attribute.name, {}, type, {}, {}}, cursor.take(type.width), Monitor::silent());
  return std::visit([](const auto& values) { return static_cast<double>(values.front()); }, one.values);
}

}  // namespace asperity
