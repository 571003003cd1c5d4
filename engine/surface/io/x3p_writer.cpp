// SPDX-License-Identifier: GPL-3.0-or-later
// Writes X3P (ISO 25178-72): incremental x and y, absolute z in double precision, MD5. A fixed date makes
// output deterministic. libzip builds the archive in memory; only packed bytes are copied. Missing points
// are NaN: the valid-points mask of the standard is for integers.
#include <zip.h>

#include <array>
#include <bit>
#include <charconv>
#include <span>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/archive.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

namespace {

// To 21 digits.
std::string increment(double size, int count) {
  std::array<char, 64> buffer;
  const auto [end, failure] = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                            static_cast<long double>(size) / static_cast<long double>(count),
                                            std::chars_format::scientific, 20);
  if (failure != std::errc{}) throw Error(ErrorCode::internal, "an increment was not written");
  return {buffer.data(), end};
}

std::string main_xml(const Grid& grid, const std::string& md5) {
  return R"(<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.opengps.eu/2008/ISO5436_2 http://www.opengps.eu/2008/ISO5436_2/ISO5436_2.xsd">
  <Record1>
    <Revision>ISO5436 - 2000</Revision>
    <FeatureType>SUR</FeatureType>
    <Axes>
      <CX><AxisType>I</AxisType><DataType>D</DataType><Increment>)" +
         increment(grid.size_x, grid.nx) + R"(</Increment><Offset>0</Offset></CX>
      <CY><AxisType>I</AxisType><DataType>D</DataType><Increment>)" +
         increment(grid.size_y, grid.ny) + R"(</Increment><Offset>0</Offset></CY>
      <CZ><AxisType>A</AxisType><DataType>D</DataType></CZ>
    </Axes>
  </Record1>
  <Record2>
    <Date>1970-01-01T00:00:00</Date>
    <Instrument>
      <Manufacturer>Asperity</Manufacturer>
      <Model>Asperity</Model>
      <Serial>not available</Serial>
      <Version>1</Version>
    </Instrument>
    <CalibrationDate>1970-01-01T00:00:00</CalibrationDate>
    <ProbingSystem><Type>Software</Type><Identification>not available</Identification></ProbingSystem>
  </Record2>
  <Record3>
    <MatrixDimension><SizeX>)" +
         std::to_string(grid.nx) + "</SizeX><SizeY>" + std::to_string(grid.ny) +
         R"(</SizeY><SizeZ>1</SizeZ></MatrixDimension>
    <DataLink>
      <PointDataLink>bindata/data.bin</PointDataLink>
      <MD5ChecksumPointData>)" +
         md5 + R"(</MD5ChecksumPointData>
    </DataLink>
  </Record3>
  <Record4>
    <ChecksumFile>md5checksum.hex</ChecksumFile>
  </Record4>
</p:ISO5436_2>
)";
}

std::string md5_of(std::span<const char> bytes) {
  Md5 md5;
  md5.add(bytes);
  return md5.hex();
}

}  // namespace

// Throws Error{bad_file} if writing fails. Increments have more digits than a double, so the size reads
// back exactly.
void write_x3p(const Surface& surface, const std::string& path) {
  static_assert(std::endian::native == std::endian::little, "X3P data are written as they lie in memory");
  const auto heights = surface.measured_heights().values();
  const std::span<const char> data{reinterpret_cast<const char*>(heights.data()), heights.size_bytes()};
  const std::string xml = main_xml(surface.grid(), md5_of(data));
  const std::string checksum = md5_of(xml) + " *main.xml\n";

  AtomicFile file(path, FileWords::data);
  // A temporary file of libzip would survive a killed process.
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* archive = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_t* zip = archive == nullptr ? nullptr : zip_open_from_source(archive, ZIP_TRUNCATE, &error);
  const auto refuse = [&](const std::string& reason) {
    if (zip != nullptr) zip_discard(zip);
    if (archive != nullptr) zip_source_free(archive);
    throw Error(ErrorCode::bad_file, file_name(path) + " cannot be written: " + reason,
                "check permission and space on the disk");
  };
  if (zip == nullptr) refuse(zip_error_strerror(&error));
  zip_source_keep(archive);
  const auto add = [&](const char* name, std::span<const char> bytes) {
    zip_source_t* source = zip_source_buffer(zip, bytes.data(), bytes.size(), 0);
    const zip_int64_t index = source == nullptr ? -1 : zip_file_add(zip, name, source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      if (source != nullptr) zip_source_free(source);
      refuse(zip_strerror(zip));
    }
    constexpr zip_uint16_t first_of_january_1980 = (1 << 5) | 1;
    if (zip_file_set_dostime(zip, static_cast<zip_uint64_t>(index), 0, first_of_january_1980, 0) != 0)
      refuse(zip_strerror(zip));
  };
  add("main.xml", xml);
  add("bindata/data.bin", data);
  add("md5checksum.hex", checksum);
  if (zip_close(zip) != 0) refuse(zip_strerror(zip));
  zip = nullptr;
  zip_stat_t facts;
  if (zip_source_stat(archive, &facts) != 0 || zip_source_open(archive) != 0)
    refuse(zip_error_strerror(zip_source_error(archive)));
  std::string bytes(facts.size, '\0');
  const zip_int64_t taken = zip_source_read(archive, bytes.data(), bytes.size());
  zip_source_close(archive);
  if (taken != static_cast<zip_int64_t>(bytes.size())) refuse("the archive cannot be read back");
  zip_source_free(archive);
  file.write(bytes);
  file.commit();
}

}  // namespace asperity
