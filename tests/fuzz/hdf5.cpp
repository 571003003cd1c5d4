// SPDX-License-Identifier: GPL-3.0-or-later
// Wrong addresses, sizes and trees. Deflate expands up to 1032 times; a byte may become an integer and a
// height.
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"

#include "engine/surface/io/hdf5_reader/hdf5_objects.hpp"
#include "tests/fuzz/height_map.hpp"

static void fuzz_hdf5(const std::uint8_t* data, std::size_t size) {
  using namespace asperity::fuzz;
  constexpr std::size_t bytes_per_byte = 1032 * 24, beside = std::size_t{48} << 20;
  ListeningMonitor monitor;
  refused(beside + bytes_per_byte * size, [&] {
    const asperity::Hdf5Content content = read_hdf5(asperity::SourceFile("input", view(data, size)), monitor);
    for (const asperity::Hdf5Array& array : content.arrays) {
      std::size_t product = 1;
      for (const std::size_t side : array.shape) product *= side;
      const std::size_t count = std::visit([](const auto& values) { return values.size(); }, array.values);
      require(count == product, "the numbers fill the shape");
    }
  });
  read_every_way(view(data, size), {.format = "hdf5",
                                    .bytes_per_byte = bytes_per_byte,
                                    .beside = beside,
                                    .fill = asperity::HoleFill::with(0)});
}

static const asperity::fuzz::Target hdf5_target{"hdf5", fuzz_hdf5,
                                                [] { asperity::hdf5_checksums_are_compared = false; }};
