// SPDX-License-Identifier: GPL-3.0-or-later
// Digests cover shape and values.
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <mutex>
#include <set>

#include "engine/core/digest.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/loaded_part.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/io/hdf5/write_call.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"

namespace asperity {

namespace {

constexpr LoadedPart part{"hdf5", "HDF5 files are written", "libhdf5-103-1"};
constexpr std::size_t longest_text = 60000;

std::size_t count_of(const Hdf5Values& values) {
  return std::visit([](const auto& span) { return span.size(); }, values);
}

std::string_view bytes_of(const Hdf5Values& values) {
  return std::visit(
      [](const auto& span) {
        return std::string_view(reinterpret_cast<const char*>(span.data()), span.size_bytes());
      },
      values);
}

std::string digest_of(const Hdf5Array& array) {
  Digester digester;
  digester.add(static_cast<std::int64_t>(array.values.index()));
  for (const std::size_t side : array.shape) digester.add(static_cast<std::int64_t>(side));
  return digester.add(bytes_of(array.values)).hex();
}

// Accepts a name of a group member.
bool is_name(std::string_view name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string_view::npos &&
         name.find('\0') == std::string_view::npos;
}

// Slashes only in names of groups and arrays.
void check_name(const std::string& name, bool parted) {
  bool good = !name.empty() && name.find('\0') == std::string::npos;
  for (std::size_t start = 0; parted && good && start <= name.size();) {
    const std::size_t end = std::min(name.find('/', start), name.size());
    good = is_name(std::string_view(name).substr(start, end - start));
    start = end + 1;
  }
  if (!good)
    refuse(quoted(name) + " cannot be a name in an HDF5 file",
           "parts between `/` are neither empty nor `.` nor `..`");
}

void check_text(const std::string& name, const std::string& text) {
  check_name(name, false);
  if (name.size() + text.size() > longest_text)
    refuse("the text " + quoted(name) + " has " + std::to_string(text.size()) +
               " bytes, more than an attribute of an HDF5 file holds",
           "store it as an array of bytes");
  if (text.find('\0') != std::string::npos) refuse("the text " + quoted(name) + " has a zero byte within");
}

void check_array(const Hdf5Array& array) {
  check_name(array.name, true);
  check_text("unit", array.unit);
  std::size_t product = 1;
  for (const std::size_t side : array.shape) product *= side;
  if (array.shape.size() > 32 || product != count_of(array.values))
    refuse("the shape of " + quoted(array.name) + " holds " + std::to_string(product) +
           " numbers and there are " + std::to_string(count_of(array.values)));
}

// Names are unique; no group is an array.
void check_names(const Hdf5Content& content) {
  std::set<std::string> arrays, groups, texts;
  const auto twice = [](const std::string& name) {
    refuse(quoted(name) + " is given twice for one HDF5 file",
           "give each array, group and text its own name");
  };
  for (const auto& [name, text] : content.texts)
    if (!texts.insert(name).second) twice(name);
  for (const auto& [name, number] : content.numbers)
    if (!texts.insert(name).second) twice(name);
  for (const Hdf5Array& array : content.arrays) {
    if (!arrays.insert(array.name).second) twice(array.name);
    for (std::size_t at = array.name.find('/'); at != std::string::npos; at = array.name.find('/', at + 1))
      groups.insert(array.name.substr(0, at));
  }
  for (const std::string& name : arrays)
    if (groups.count(name) != 0) twice(name);
}

// Null if missing.
template <class T>
const T* named(const std::vector<std::pair<std::string, T>>& pairs, std::string_view name) {
  const auto found = std::ranges::find(pairs, name, &std::pair<std::string, T>::first);
  return found == pairs.end() ? nullptr : &found->second;
}

class Reader {
 public:
  Reader(const SourceFile& file, Monitor& monitor)
      : file_(open_hdf5(file)), room_(file_.bytes.size()), monitor_(monitor) {
    warn_of_bytes_over(file, file_.over, monitor);
  }

  Hdf5Content read() {
    visit("", file_.root, 0);
    return std::move(content_);
  }

 private:
  void visit(const std::string& name, std::uint64_t address, int depth) {
    constexpr int deepest = 64;
    if (depth > deepest) refuse_file(file_.file, "is damaged, or has groups in groups more than 64 deep");
    if (!seen_.insert(address).second) {
      content_.unread.push_back(quoted(name) + ": another name of something read already");
      return;
    }
    const Hdf5Header header = read_header(file_, address);
    if (header.find(Hdf5MessageKind::layout) != nullptr) {
      read_array(name, header);
      return;
    }
    if (depth == 0) read_attributes(header);
    for (const Hdf5Link& link : read_members(file_, header, content_.unread)) {
      if (!is_name(link.name)) file_.damaged("a member has an invalid name");
      visit(name.empty() ? link.name : name + "/" + link.name, link.address, depth + 1);
    }
  }

  void read_attributes(const Hdf5Header& header) {
    for (const Hdf5Message& message : header.messages) {
      if (message.kind != Hdf5MessageKind::attribute) continue;
      const Hdf5Attribute attribute = read_attribute(file_, message.body);
      if (const auto text = text_of(file_, attribute)) {
        content_.texts.emplace_back(attribute.name, *text);
      } else if (const auto number = number_of(file_, attribute)) {
        content_.numbers.emplace_back(attribute.name, *number);
      } else {
        content_.unread.push_back(quoted(attribute.name) + ": an attribute that is neither text nor number");
      }
    }
  }

  void read_array(const std::string& name, const Hdf5Header& header) {
    const Hdf5Message* const space = header.find(Hdf5MessageKind::dataspace);
    const Hdf5Message* const type = header.find(Hdf5MessageKind::datatype);
    const Hdf5Message* const layout = header.find(Hdf5MessageKind::layout);
    const Hdf5Message* const filters = header.find(Hdf5MessageKind::filters);
    if (space == nullptr || type == nullptr) file_.damaged(quoted(name) + " has no shape or no type");
    if (space->shared || type->shared || (filters != nullptr && filters->shared)) {
      content_.unread.push_back(quoted(name) + ": values stored elsewhere in the file");
      return;
    }
    Hdf5Dataset dataset{name, read_shape(file_, space->body), read_type(file_, type->body), {}, {}};
    dataset.layout = read_layout(file_, layout->body, dataset.shape.sizes.size());
    if (filters != nullptr) dataset.filters = read_filters(file_, filters->body);
    if (const std::string reason = why_unread(dataset); !reason.empty()) {
      content_.unread.push_back(quoted(name) + ": " + reason);
      return;
    }
    Hdf5Array array = read_numbers(file_, dataset, room_, monitor_);
    std::optional<std::string> digest;
    for (const Hdf5Message& message : header.messages) {
      if (message.kind != Hdf5MessageKind::attribute) continue;
      const Hdf5Attribute attribute = read_attribute(file_, message.body);
      if (attribute.name == "unit" || (attribute.name == "units" && array.unit.empty()))
        array.unit = text_of(file_, attribute).value_or("");
      if (attribute.name == "_FillValue") array.missing = number_of(file_, attribute);
      if (attribute.name == "digest") digest = text_of(file_, attribute);
    }
    // Other programs' digests differ in length.
    constexpr std::size_t digits = 32;
    if (digest && digest->size() == digits && *digest != digest_of(array))
      file_.damaged("the numbers of " + quoted(name) + " do not have the digest that they were written with",
                    "the file was altered after it was written");
    content_.arrays.push_back(std::move(array));
  }

  Hdf5Bytes file_;
  std::uint64_t room_;
  Monitor& monitor_;
  std::set<std::uint64_t> seen_;
  Hdf5Content content_;
};

}  // namespace

const Hdf5Array* Hdf5Content::array(std::string_view name) const {
  const auto found = std::ranges::find(arrays, name, &Hdf5Array::name);
  return found == arrays.end() ? nullptr : &*found;
}

const std::string* Hdf5Content::text(std::string_view name) const { return named(texts, name); }

const double* Hdf5Content::number(std::string_view name) const { return named(numbers, name); }

void write_hdf5(const std::filesystem::path& path, const Hdf5Content& content) {
  std::vector<AsperityHdf5Text> texts;
  for (const auto& [name, text] : content.texts) {
    check_text(name, text);
    texts.push_back({name.c_str(), text.c_str()});
  }
  std::vector<AsperityHdf5Number> numbers;
  for (const auto& [name, number] : content.numbers) {
    check_name(name, false);
    numbers.push_back({name.c_str(), number});
  }
  check_names(content);
  // A deque keeps addresses valid.
  std::deque<std::string> digests;
  std::vector<AsperityHdf5Array> arrays;
  for (const Hdf5Array& array : content.arrays) {
    check_array(array);
    const std::string& digest = digests.emplace_back(digest_of(array));
    constexpr std::array kinds{asperity_hdf5_double, asperity_hdf5_int64, asperity_hdf5_uint8};
    arrays.push_back({array.name.c_str(), kinds[array.values.index()], static_cast<int>(array.shape.size()),
                      array.shape.data(), bytes_of(array.values).data(), array.unit.c_str(), digest.c_str()});
  }
  const AsperityHdf5File file{texts.data(),   texts.size(),  numbers.data(),
                              numbers.size(), arrays.data(), arrays.size()};
  auto* const write = part_function<AsperityHdf5Write>(part, "asperity_hdf5_write_2");

  AtomicFile staged(path, FileWords::data);
  static std::mutex one_at_a_time;
  std::array<char, 512> reason{};
  {
    const std::lock_guard lock(one_at_a_time);
    if (write(staged.temporary().c_str(), &file, reason.data(), reason.size()) != 0)
      refuse_bad_file(file_name(path.string()) + " cannot be written: " + reason.data(),
                      "check permission and space on the disk");
  }
  staged.commit(Durable::yes);
}

Hdf5Content read_hdf5(const std::filesystem::path& path, Monitor& monitor) {
  return read_hdf5(SourceFile(path.string(), monitor), monitor);
}

Hdf5Content read_hdf5(const SourceFile& file, Monitor& monitor) { return Reader(file, monitor).read(); }

}  // namespace asperity
