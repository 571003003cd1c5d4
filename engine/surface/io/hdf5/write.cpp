// SPDX-License-Identifier: GPL-3.0-or-later
// The part asperity-hdf5.so: writes arrays with the HDF5 library, without times.
#include <hdf5.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/surface/io/hdf5/write_call.hpp"

namespace {

// The library's reason, read before closing objects clears it. The innermost stack entry includes the
// system's message.
struct Failure {
  std::string reason = "the HDF5 library gives no reason";
  Failure() { H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason); }

  static herr_t keep_first(unsigned n, const H5E_error2_t* entry, void* text) {
    if (n != 0 || entry->desc == nullptr) return 0;
    std::string reason = entry->desc;
    constexpr std::string_view mark = "error message = '";
    if (const std::size_t at = reason.find(mark); at != std::string::npos) {
      reason.erase(0, at + mark.size());
      reason.erase(std::min(reason.find('\''), reason.size()));
    }
    *static_cast<std::string*>(text) = reason;
    return 0;
  }
};

class Handle {
 public:
  Handle(hid_t id, herr_t (*closed_by)(hid_t)) : id_(id), close_(closed_by) {
    if (id_ < 0) throw Failure{};
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  // Closing flushes and can fail.
  void close() {
    if (close_(std::exchange(id_, -1)) < 0) throw Failure{};
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void must(herr_t status) {
  if (status < 0) throw Failure{};
}

// Keeps links and attributes in the object header, readable by any reader of 1.8.
constexpr unsigned most_in_header = 60000;

void write_text(hid_t object, const AsperityHdf5Text& text) {
  const std::size_t bytes = std::char_traits<char>::length(text.value);
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  must(H5Tset_size(type, bytes == 0 ? 1 : bytes));
  must(H5Tset_strpad(type, H5T_STR_NULLPAD));
  must(H5Tset_cset(type, H5T_CSET_UTF8));
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  Handle attribute(H5Acreate2(object, text.name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  must(H5Awrite(attribute, type, text.value));
  attribute.close();
}

void write_number(hid_t object, const AsperityHdf5Number& number) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  Handle attribute(H5Acreate2(object, number.name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  must(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &number.value));
  attribute.close();
}

// The library would make intermediate groups with times.
void make_groups(hid_t file, const std::string& name) {
  for (std::size_t at = name.find('/'); at != std::string::npos; at = name.find('/', at + 1)) {
    const std::string group = name.substr(0, at);
    // Parents exist already.
    const htri_t exists = H5Lexists(file, group.c_str(), H5P_DEFAULT);
    must(exists);
    if (exists > 0) continue;
    const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    must(H5Pset_obj_track_times(creation, false));
    must(H5Pset_link_phase_change(creation, most_in_header, 0));
    Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
    made.close();
  }
}

void write_array(hid_t file, const AsperityHdf5Array& array) {
  make_groups(file, array.name);
  hid_t in_file = H5T_IEEE_F64LE, in_memory = H5T_NATIVE_DOUBLE;
  if (array.kind == asperity_hdf5_int64) in_file = H5T_STD_I64LE, in_memory = H5T_NATIVE_INT64;
  if (array.kind == asperity_hdf5_uint8) in_file = H5T_STD_U8LE, in_memory = H5T_NATIVE_UINT8;
  hsize_t shape[H5S_MAX_RANK];
  hsize_t count = 1;
  for (int k = 0; k < array.rank; ++k) count *= shape[k] = array.shape[k];
  const Handle space(array.rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(array.rank, shape, nullptr),
                     H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  must(H5Pset_obj_track_times(creation, false));
  must(H5Pset_layout(creation, H5D_CONTIGUOUS));
  must(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY));
  must(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER));
  Handle data(H5Dcreate2(file, array.name, in_file, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  if (count > 0) must(H5Dwrite(data, in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values));
  if (*array.unit != '\0') write_text(data, {"unit", array.unit});
  write_text(data, {"digest", array.digest});
  data.close();
}

void write_file(const char* path, const AsperityHdf5File& content) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  must(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18));
  must(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));
  must(H5Pset_file_locking(access, false, true));
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  must(H5Pset_obj_track_times(creation, false));
  must(H5Pset_link_phase_change(creation, most_in_header, 0));
  must(H5Pset_attr_phase_change(creation, most_in_header, 0));
  Handle file(H5Fcreate(path, H5F_ACC_TRUNC, creation, access), H5Fclose);
  for (std::size_t k = 0; k < content.text_count; ++k) write_text(file, content.texts[k]);
  for (std::size_t k = 0; k < content.number_count; ++k) write_number(file, content.numbers[k]);
  for (std::size_t k = 0; k < content.array_count; ++k) write_array(file, content.arrays[k]);
  must(H5Fflush(file, H5F_SCOPE_GLOBAL));
  file.close();
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int asperity_hdf5_write_2(const char* path,
                                                                            const AsperityHdf5File* file,
                                                                            char* reason, std::size_t room) {
  static_assert(std::is_same_v<decltype(asperity_hdf5_write_2), AsperityHdf5Write>);
  // At exit, the library would write a failed file again and crash.
  static const herr_t left_alone = H5dont_atexit();
  (void)left_alone;
  H5E_auto2_t print = nullptr;
  void* with = nullptr;
  H5Eget_auto2(H5E_DEFAULT, &print, &with);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  int status = 0;
  try {
    write_file(path, *file);
  } catch (const Failure& failure) {
    std::snprintf(reason, room, "%s", failure.reason.c_str());
    status = 1;
  }
  H5Eset_auto2(H5E_DEFAULT, print, with);
  return status;
}
