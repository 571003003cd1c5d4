// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/hdf5_reader/hdf5_chunks.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr std::uint64_t most_from_one = 1032;

// Exactly `wanted` bytes out of a zlib stream.
Array<char> inflated(const Hdf5Bytes& file, std::string_view packed, std::size_t wanted) {
  Array<char> plain(wanted);
  uLongf length = wanted;
  const int status = ::uncompress(reinterpret_cast<Bytef*>(plain.data()), &length,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (status == Z_MEM_ERROR)
    throw Error(ErrorCode::out_of_memory,
                "no memory to unpack " + format_bytes(static_cast<std::int64_t>(wanted)));
  if (status != Z_OK || length != wanted) file.refuse("is damaged: a chunk does not unpack to its size");
  return plain;
}

// Bytes of one significance stand together; puts each number's together again.
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
  Chunks(const Hdf5Bytes& file, const Hdf5Dataset& dataset, std::uint64_t& room, Monitor& monitor)
      : file_(file),
        dataset_(dataset),
        room_(room),
        rank_(dataset.shape.sizes.size()),
        width_(dataset.type.width) {
    const std::vector<std::uint64_t>& chunk = dataset.layout.chunk;
    if (rank_ == 0 || chunk.size() != rank_ + 1 || chunk.back() != width_)
      file.refuse("is damaged: the chunks of " + quoted(dataset.name) + " are not those of its numbers");
    // Every chunk takes more than 16 bytes of the file, for its place in the tree.
    const std::uint64_t most = file.bytes.size() / 16 + 1;
    std::uint64_t count = 1;
    chunk_bytes_ = width_;
    for (std::size_t k = 0; k < rank_; ++k) {
      if (chunk[k] == 0) file.refuse("is damaged: " + quoted(dataset.name) + " has chunks of nothing");
      const std::uint64_t along = (dataset.shape.sizes[k] - 1) / chunk[k] + 1;
      if (along > most / count || chunk[k] > file.bytes.size() * most_from_one / chunk_bytes_)
        file.refuse("is damaged: it claims more numbers in " + quoted(dataset.name) + " than it can hold");
      count *= along;
      chunk_bytes_ *= chunk[k];
      along_.push_back(along);
    }
    found_.resize(count);
    const std::uint64_t total = dataset.shape.count(file) * width_;
    if (total > file.bytes.size() * most_from_one)
      file.refuse("is damaged: it claims more numbers in " + quoted(dataset.name) + " than it can hold");
    Task task(monitor, "reading", static_cast<std::int64_t>(count));
    task_ = &task;
    walk(dataset.layout.address, 0);
    if (std::find(found_.begin(), found_.end(), 0) != found_.end())
      file.refuse("holds " + quoted(dataset.name) + " of which not all numbers were written",
                  "write them all");
  }

  Array<char> take() { return std::move(values_); }

 private:
  void walk(std::uint64_t node, int depth) {
    constexpr const char* what = "a tree of chunks";
    constexpr int deepest = 16;
    if (depth > deepest || ++nodes_ > file_.bytes.size() / 24)
      file_.refuse("is damaged: a tree of chunks goes round in circles");
    const std::uint64_t head_bytes = 8 + 2 * static_cast<std::uint64_t>(file_.address_width);
    Hdf5Cursor head(file_, file_.piece(node, head_bytes, what), what);
    if (!head.starts_with("TREE") || head.number(1) != 1) head.refuse("has no mark");
    const std::uint64_t level = head.number(1), count = head.number(2);
    const std::uint64_t key_bytes = 8 + 8 * (rank_ + 1);
    Hdf5Cursor cursor(
        file_,
        file_.piece(node + head_bytes, count * (key_bytes + static_cast<std::uint64_t>(file_.address_width)),
                    what),
        what);
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::uint64_t length = cursor.number(4), skipped = cursor.number(4);
      std::vector<std::uint64_t> place;
      for (std::size_t side = 0; side <= rank_; ++side) place.push_back(cursor.number(8));
      const std::uint64_t child = cursor.address();
      if (level == 0)
        put(place, plain(file_.piece(child, length, "a chunk"), skipped));
      else
        walk(child, depth + 1);
    }
  }

  // The bytes of a chunk with its filters undone, last first.
  Array<char> plain(std::string_view stored, std::uint64_t skipped) {
    if (stored.size() > room_)
      file_.refuse("is damaged: chunks of " + quoted(dataset_.name) + " lie over each other");
    room_ -= stored.size();
    Array<char> bytes;
    bool packed = true;
    for (std::size_t k = dataset_.filters.size(); k-- > 0;) {
      if (k < 32 && (skipped >> k & 1) != 0) continue;
      const std::string_view now = packed ? stored : std::string_view(bytes.data(), bytes.size());
      switch (dataset_.filters[k].id) {
        case Hdf5Filter::fletcher32: {
          constexpr std::size_t sum = 4;
          if (now.size() < sum) file_.refuse("is damaged: a chunk is shorter than its checksum");
          const std::string_view content = now.substr(0, now.size() - sum);
          if (Hdf5Cursor(file_, now.substr(content.size()), "").number(sum) != fletcher32(content))
            file_.refuse("is damaged: the checksum of a chunk of " + quoted(dataset_.name) +
                         " is not that of its bytes");
          bytes = Array<char>(content.begin(), content.end());
          break;
        }
        case Hdf5Filter::deflate: {
          if (chunk_bytes_ / most_from_one > now.size())
            file_.refuse("is damaged: a chunk does not unpack to its size");
          // A checksum made before the compression is in it.
          const bool summed =
              std::any_of(dataset_.filters.begin(), dataset_.filters.begin() + static_cast<std::ptrdiff_t>(k),
                          [](const Hdf5Filter& f) { return f.id == Hdf5Filter::fletcher32; });
          Array<char> unpacked = inflated(file_, now, chunk_bytes_ + (summed ? 4 : 0));
          bytes = std::move(unpacked);
          break;
        }
        default: {
          const Array<char> mixed(now.begin(), now.end());
          bytes = unshuffled(mixed, width_);
        }
      }
      packed = false;
    }
    if (packed) bytes = Array<char>(stored.begin(), stored.end());
    if (bytes.size() != chunk_bytes_)
      file_.refuse("is damaged: a chunk of " + quoted(dataset_.name) + " is not of its size");
    return bytes;
  }

  void put(const std::vector<std::uint64_t>& place, const Array<char>& bytes) {
    const std::vector<std::uint64_t>& sizes = dataset_.shape.sizes;
    const std::vector<std::uint64_t>& chunk = dataset_.layout.chunk;
    std::uint64_t index = 0;
    for (std::size_t k = 0; k < rank_; ++k) {
      if (place[k] >= sizes[k] || place[k] % chunk[k] != 0)
        file_.refuse("is damaged: a chunk of " + quoted(dataset_.name) + " lies outside it");
      index = index * along_[k] + place[k] / chunk[k];
    }
    if (found_[index] != 0)
      file_.refuse("is damaged: a chunk of " + quoted(dataset_.name) + " is there twice");
    found_[index] = 1;
    // Made when the first chunk has shown itself to be as large as it claims.
    if (values_.empty()) values_.resize(dataset_.shape.count(file_) * width_);
    const std::uint64_t run =
        std::min(chunk.back() == 0 ? 0 : chunk[rank_ - 1], sizes[rank_ - 1] - place[rank_ - 1]) * width_;
    std::vector<std::uint64_t> at(rank_, 0);
    while (true) {
      std::uint64_t from = 0, to = 0;
      for (std::size_t k = 0; k < rank_; ++k) {
        from = from * chunk[k] + at[k];
        to = to * sizes[k] + place[k] + at[k];
      }
      std::memcpy(values_.data() + to * width_, bytes.data() + from * width_, run);
      // The next row of the chunk that lies inside the array.
      std::size_t side = rank_ - 1;
      while (side-- > 0) {
        if (++at[side] < chunk[side] && place[side] + at[side] < sizes[side]) break;
        at[side] = 0;
        if (side == 0) {
          task_->advance();
          return;
        }
      }
      if (rank_ == 1) {
        task_->advance();
        return;
      }
    }
  }

  const Hdf5Bytes& file_;
  const Hdf5Dataset& dataset_;
  std::uint64_t& room_;
  std::size_t rank_, width_;
  std::uint64_t chunk_bytes_ = 0;
  std::vector<std::uint64_t> along_;  // chunks along each side
  Array<std::uint8_t> found_;
  Array<char> values_;
  std::size_t nodes_ = 0;
  Task* task_ = nullptr;
};

}  // namespace

std::string why_chunks_unread(const Hdf5Dataset& dataset) {
  for (const Hdf5Filter& filter : dataset.filters)
    if (filter.id != Hdf5Filter::deflate && filter.id != Hdf5Filter::shuffle &&
        filter.id != Hdf5Filter::fletcher32)
      return "numbers compressed by the filter " + std::to_string(filter.id) +
             " (deflate and shuffle are read)";
  return {};
}

Array<char> read_chunks(const Hdf5Bytes& file, const Hdf5Dataset& dataset, std::uint64_t& room,
                        Monitor& monitor) {
  return Chunks(file, dataset, room, monitor).take();
}

}  // namespace asperity
