// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/monitor.hpp"

namespace asperity::test {

class Warnings final : public Monitor {
 public:
  void progress(std::string_view, double) override {}
  void warn(std::string_view sentence) override { all.emplace_back(sentence); }
  bool told(std::string_view part) const {
    for (const std::string& warning : all)
      if (warning.find(part) != std::string::npos) return true;
    return false;
  }
  std::vector<std::string> all;
};

}  // namespace asperity::test
