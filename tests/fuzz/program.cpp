// SPDX-License-Identifier: GPL-3.0-or-later
// --target=NAME selects a target. libFuzzer ignores options with two dashes.
#include <cstring>
#include <vector>

#include "tests/fuzz/target.hpp"

namespace asperity::fuzz {
namespace {

std::vector<const Target*>& targets() {
  static std::vector<const Target*> all;
  return all;
}

const Target* chosen = nullptr;

}  // namespace

Target::Target(const char* its_name, Run runs, Prepare prepares)
    : name(its_name), run(runs), prepare(prepares) {
  targets().push_back(this);
}

}  // namespace asperity::fuzz

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  using namespace asperity::fuzz;
  constexpr const char* option = "--target=";
  for (int k = 1; k < *count; ++k) {
    const char* const argument = (*arguments)[k];
    if (std::strncmp(argument, option, std::strlen(option)) != 0) continue;
    for (const Target* target : targets())
      if (std::strcmp(target->name, argument + std::strlen(option)) == 0) chosen = target;
  }
  if (chosen == nullptr) {
    std::fprintf(stderr, "name a target:");
    for (const Target* target : targets()) std::fprintf(stderr, " %s%s", option, target->name);
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  if (chosen->prepare != nullptr) chosen->prepare();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::fuzz::chosen->run(data, size);
  return 0;
}
