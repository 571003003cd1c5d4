// SPDX-License-Identifier: GPL-3.0-or-later
// A block for options described by the engine (core/options.hpp).
#pragma once

#include <any>
#include <span>
#include <string>
#include <vector>

#include "bindings/lua/registry/block.hpp"
#include "engine/core/options.hpp"

namespace asperity::lua {

OptionInfo row_info(const OptionRow& row, const std::any& defaults);
void read_row(const OptionRow& row, const OptionInfo& info, const Argument& value, std::any& options,
              Problems& problems);

class RowBlock final : public BlockInfo {
 public:
  // `rows` must outlive the block. `defaults`: the struct without options.
  RowBlock(std::string name, std::span<const OptionRow> rows, std::any defaults);

  const std::string& name() const override { return name_; }
  std::vector<const OptionInfo*> options() const override;
  std::any read(const Argument& table, const std::string& caller) const;
  void check(const Argument& table, const std::string& caller) const override { (void)read(table, caller); }

 private:
  std::string name_;
  std::span<const OptionRow> rows_;
  std::any defaults_;
  std::vector<OptionInfo> infos_;
};

}  // namespace asperity::lua
