// SPDX-License-Identifier: GPL-3.0-or-later
// Case rows as bytes. Missing surface points are NaN heights.
#include <algorithm>
#include <type_traits>

#include "bindings/lua/ensemble/byte_fields.hpp"
#include "bindings/lua/ensemble/packed_value.hpp"
#include "bindings/lua/registry/value.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

constexpr std::string_view form = "asperity value 1";
// Nested results: above real depths, within the stack.
constexpr int deepest_packed = 200;

enum class Tag : std::uint8_t {
  nil,
  truth,
  integer,
  number,
  text,
  node,
  given,
  surface,
  profile,
  material,
  record,
  list,
  map,
  numbers,
  rows
};

// "" if it has one.
std::string no_bytes_for(const Object& object) {
  if (object.pointer == nullptr) return object.type->article_name + " that was closed";
  if (object.type == &class_of<Surface>())
    return static_cast<const Surface*>(object.pointer.get())->recipe() == nullptr
               ? ""
               : "a surface that its generator can make again on other cells";
  if (object.type == &class_of<Profile>() || object.type == &class_of<Material>()) return "";
  return object.type->article_name;
}

const Value* same_object(const Object& object, const std::vector<Value>& given, std::size_t& place) {
  for (place = 0; place < given.size(); ++place)
    if (const auto* other = std::get_if<Object>(&given[place].data);
        other != nullptr && other->pointer == object.pointer && object.pointer != nullptr)
      return &given[place];
  return nullptr;
}

}  // namespace

struct PackedValue::Writer : ValueVisitor {
  const PackedValue& packed;
  const std::string& name;
  const std::vector<Value>& given;
  ByteWriter out{};
  std::uint32_t node = 0;  // being written
  int depth = 0;

  Writer(const PackedValue& written, const std::string& called, const std::vector<Value>& at_hand)
      : packed(written), name(called), given(at_hand) {}

  void tag(Tag value) { out.number(static_cast<std::uint8_t>(value)); }
  void put(Tag kind, const auto& value) {
    tag(kind);
    write_fields(out, value);
  }
  // "run(case).bench"
  std::string path_to(std::uint32_t to, int steps = 0) const {
    if (const auto* root = std::get_if<NodeId>(&packed.root_);
        steps > 50 || (root != nullptr && root->index == to))
      return name;
    for (std::uint32_t k = 0; k < packed.nodes_.size(); ++k) {
      const auto* table = std::get_if<Table>(&packed.nodes_[k]);
      if (table == nullptr || k == to) continue;
      for (const Entry& entry : table->entries) {
        const auto* id = std::get_if<NodeId>(&entry.value);
        if (id == nullptr || id->index != to) continue;
        std::string step = "[...]";
        if (const auto* text = std::get_if<std::string>(&entry.key))
          step = step_text(*text);
        else if (const auto* whole = std::get_if<std::int64_t>(&entry.key))
          step = "[" + std::to_string(*whole) + "]";
        return path_to(k, steps + 1) + step;
      }
    }
    return name;
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ErrorCode::not_permitted,
                quoted(path_to(node)) + " holds " + what +
                    ", which can neither be stored in a file nor sent to another process",
                "return numbers read off it, or a surface's :heights()");
  }

  void leaf(const Object& object) {
    std::size_t place = 0;
    if (same_object(object, given, place) != nullptr) {
      return put(Tag::given, static_cast<std::uint64_t>(place));
    }
    if (const std::string refused = no_bytes_for(object); !refused.empty()) refuse(refused);
    if (object.type == &class_of<Surface>()) {
      const auto& surface = *static_cast<const Surface*>(object.pointer.get());
      tag(Tag::surface);
      write_fields(out, surface.grid());
      out.numbers(surface.measured_heights().values());
      write_fields(out, surface.traits().periodic);
      write_fields(out, surface.traits().aliased_share);
      write_fields(out, surface.material());
    } else if (object.type == &class_of<Profile>()) {
      const auto& profile = *static_cast<const Profile*>(object.pointer.get());
      tag(Tag::profile);
      out.number(profile.spacing());
      out.numbers(profile.measured_heights());
      write_fields(out, profile.closed_radius());
    } else {
      put(Tag::material, *static_cast<const Material*>(object.pointer.get()));
    }
  }
  void begin(const Value&) {
    if (++depth > deepest_packed)
      refuse("results within results, more than " + std::to_string(deepest_packed) + " deep");
  }
  void end() { --depth; }
  void named(std::size_t count) { out.number(static_cast<std::uint64_t>(count)); }
  bool under(const std::string& key) {
    out.text(key);
    return true;
  }
  void enter(const Record& record) {
    tag(Tag::record);
    out.text(record.name);
    named(record.entries.size());
  }
  void after(const Record::Entry& entry) { write_fields(out, entry.dimension); }
  void leave(const Record& record) { write_fields(out, record.missing_effects); }
  void enter(const List& list) {
    tag(Tag::list);
    named(list.items.size());
  }
  void enter(const Map&) { tag(Tag::map); }
  void leaf(std::monostate) { tag(Tag::nil); }
  void leaf(bool truth) { put(Tag::truth, truth); }
  void leaf(std::int64_t number) { put(Tag::integer, number); }
  void leaf(double number) { put(Tag::number, number); }
  void leaf(const std::string& text) { put(Tag::text, text); }
  void leaf(const Value::Numbers& numbers) {
    tag(Tag::numbers);
    out.numbers(*numbers);
  }
  void leaf(const Value::Rows& rows) {
    tag(Tag::rows);
    out.number(rows->nx());
    out.number(rows->ny());
    out.numbers(rows->values());
  }
  void leaf(const auto&) { refuse("a result that holds functions"); }
  void write(const Item& item) {
    std::visit(
        [&](const auto& held) {
          using Held = std::decay_t<decltype(held)>;
          if constexpr (std::is_same_v<Held, NodeId>) {
            put(Tag::node, held.index);
          } else if constexpr (std::is_same_v<Held, std::monostate> || std::is_same_v<Held, bool> ||
                               std::is_same_v<Held, std::int64_t> || std::is_same_v<Held, double> ||
                               std::is_same_v<Held, std::string>) {
            leaf(held);
          } else {
            refuse("a part of Lua's library");
          }
        },
        item);
  }

  std::string all() {
    out.text(form);
    out.number(static_cast<std::uint64_t>(packed.nodes_.size()));
    for (node = 0; node < packed.nodes_.size(); ++node) {
      if (const auto* value = std::get_if<Value>(&packed.nodes_[node])) {
        out.number(false);
        visit_value(*value, *this);
        continue;
      }
      const auto* table = std::get_if<Table>(&packed.nodes_[node]);
      if (table == nullptr || !std::holds_alternative<std::monostate>(table->metatable)) refuse("a function");
      out.number(true);
      out.number(table->length);
      out.number(static_cast<std::uint64_t>(table->entries.size()));
      for (const Entry& entry : table->entries) {
        write(entry.key);
        write(entry.value);
      }
    }
    write(packed.root_);
    return out.take();
  }
};

struct PackedValue::Reader {
  ByteReader in;
  const std::vector<Value>& given;
  std::size_t nodes = 0;
  int depth = 0;

  template <class T>
  T fields() {
    T value{};
    read_fields(in, value);
    return value;
  }
  Array<double> numbers() {
    return in.numbers([](std::size_t length) { return Array<double>(length); });
  }
  Field field() {
    const int nx = in.number<int>(), ny = in.number<int>();
    const Array<double> values = numbers();
    if (nx < 0 || ny < 0 || static_cast<std::uint64_t>(nx) * static_cast<std::uint64_t>(ny) != values.size())
      ByteReader::damaged();
    Field result(nx, ny);
    std::ranges::copy(values, result.values().begin());
    return result;
  }
  Value surface() {
    const Grid grid = fields<Grid>();
    const Array<double> values = numbers();
    if (grid.nx < 1 || grid.ny < 1 || grid.nodes() != values.size()) ByteReader::damaged();
    Field heights(grid.nx, grid.ny);
    std::ranges::copy(values, heights.values().begin());
    SurfaceTraits traits;
    traits.periodic = in.truth();
    read_fields(in, traits.aliased_share);
    read_fields(in, traits.material);
    return object(Surface::with_holes(grid, std::move(heights), std::move(traits)));
  }
  Value profile() {
    const auto spacing = in.number<double>();
    Array<double> heights = numbers();
    return object(Profile::with_holes(spacing, std::move(heights), fields<std::optional<double>>()));
  }
  Value record() {
    Record result;
    result.name = in.text();
    for (std::size_t left = in.count(); left > 0; --left) {
      Record::Entry entry{in.text(), {}, {}};
      entry.value = value();
      read_fields(in, entry.dimension);
      result.entries.push_back(std::move(entry));
    }
    read_fields(in, result.missing_effects);
    return result;
  }
  std::vector<std::pair<std::string, Value>> named() {
    std::vector<std::pair<std::string, Value>> result;
    for (std::size_t left = in.count(); left > 0; --left) {
      std::string key = in.text();
      result.emplace_back(std::move(key), value());
    }
    return result;
  }
  Tag tag() {
    const auto found = in.number<std::uint8_t>();
    if (found > static_cast<std::uint8_t>(Tag::rows)) ByteReader::damaged();
    return static_cast<Tag>(found);
  }
  Value value() { return value(tag()); }
  Value value(Tag kind) {
    if (++depth > deepest_packed) ByteReader::damaged();
    Value result = [&]() -> Value {
      if (kind == Tag::nil) return {};
      if (kind == Tag::truth) return in.truth();
      if (kind == Tag::integer) return in.number<std::int64_t>();
      if (kind == Tag::number) return in.number<double>();
      if (kind == Tag::text) return in.text();
      if (kind == Tag::surface) return surface();
      if (kind == Tag::profile) return profile();
      if (kind == Tag::material) return object(fields<Material>());
      if (kind == Tag::record) return record();
      if (kind == Tag::numbers) return std::make_shared<const Array<double>>(numbers());
      if (kind == Tag::rows) return std::make_shared<const Field>(field());
      if (kind == Tag::map) return Map{named()};
      if (kind == Tag::list) {
        List list;
        for (std::size_t left = in.count(); left > 0; --left) list.items.push_back(value());
        list.named = named();
        return list;
      }
      const auto place = kind == Tag::given ? in.number<std::uint64_t>() : given.size();
      if (place >= given.size()) ByteReader::damaged();
      return given[static_cast<std::size_t>(place)];
    }();
    --depth;
    return result;
  }
  Item item() {
    const Tag kind = tag();
    if (kind == Tag::node) {
      const auto index = in.number<std::uint32_t>();
      if (index >= nodes) ByteReader::damaged();
      return NodeId{index};
    }
    const Value plain = kind <= Tag::text ? value(kind) : (ByteReader::damaged(), Value());
    return std::visit(
        [](const auto& held) -> Item {
          if constexpr (std::is_constructible_v<Item, decltype(held)>)
            return held;
          else
            ByteReader::damaged();
        },
        plain.data);
  }

  std::shared_ptr<const PackedValue> all() {
    if (in.text() != form) ByteReader::damaged();
    auto packed = std::make_shared<PackedValue>();
    nodes = in.count(2);
    for (std::size_t k = 0; k < nodes; ++k) {
      if (!in.truth()) {
        packed->nodes_.emplace_back(value());
        continue;
      }
      Table table;
      table.length = in.number<std::uint32_t>();
      for (std::size_t left = in.count(2); left > 0; --left) {
        Entry entry;
        entry.key = item();
        const auto* number = std::get_if<double>(&entry.key);
        if (std::holds_alternative<std::monostate>(entry.key) || (number != nullptr && *number != *number))
          ByteReader::damaged();
        entry.value = item();
        table.entries.push_back(std::move(entry));
      }
      packed->nodes_.emplace_back(std::move(table));
    }
    packed->root_ = item();
    if (!in.at_end()) ByteReader::damaged();
    return packed;
  }
};

std::string PackedValue::bytes(const std::string& name, const std::vector<Value>& given) const {
  return Writer(*this, name, given).all();
}

std::shared_ptr<const PackedValue> PackedValue::from_bytes(std::string_view bytes,
                                                           const std::vector<Value>& given) {
  return Reader{ByteReader(bytes), given}.all();
}

}  // namespace asperity::lua
