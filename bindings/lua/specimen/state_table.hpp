// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of c:sweep{…}:table{…} and protocol:apply(c, {…}).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/registry/registry.hpp"
#include "engine/metrology/stylus.hpp"
#include "engine/specimen/specimen_pair.hpp"
#include "engine/statistics/table.hpp"

namespace asperity::lua {

struct TraceKeys {
  std::shared_ptr<Stylus> stylus;  // null without traces
  int count = 1;
  std::uint64_t seed = 1;
  std::optional<double> section;  // of ISO 21920-2; without it, of the unfiltered trace
};

// Collects rows. A column is a field of a State, a field of an event (`event`, `kind`, `press`), a roughness
// parameter of a body (`lower.Ra`), or the mean roughness of the traces on the lower body (`trace.Ra`). A
// unit in brackets is its display unit.
class StateTable {
 public:
  // Throws Error{unknown_name} for a missing field, and Error{bad_unit} for a unit of another dimension.
  StateTable(const std::vector<std::string>& names, TraceKeys traces);
  // Adds the errors of all names to `problems`.
  static void find_mistakes(const std::vector<std::string>& names, const TraceKeys& traces,
                            Problems& problems);

  struct Turn {
    Value state;             // nil without press
    Value event;             // nil in a sweep
    std::int64_t press = 0;  // presses so far
    std::shared_ptr<SpecimenPair> pair;
  };
  void add(Call& call, const Turn& turn);
  Table finish() && { return std::move(table_); }

 private:
  struct Column {
    std::string owner, field, name;  // "lower", "Ra", "lower.Ra"
  };
  bool needs(const std::string& owner) const;

  std::vector<Column> columns_;
  TraceKeys traces_;
  Table table_;
};

// For :table on the iterator of a sweep.
Value table_of_states(Call& call, const std::shared_ptr<SpecimenPair>& pair,
                      const std::function<std::optional<Values>()>& turn);

// For :table in a dry run: throws an Error that lists the mistakes of all columns.
void look_at_columns_of_states(const Call& call);

}  // namespace asperity::lua
