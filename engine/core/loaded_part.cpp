// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/loaded_part.hpp"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

namespace fs = std::filesystem;

// The object with this code.
struct Own {
  fs::path folder;  // empty if unknown
  bool program = true;
};

Own own_object() {
  Dl_info object{};
  void* found = nullptr;
  std::error_code failure;
  if (::dladdr1(reinterpret_cast<void*>(&own_object), &object, &found, RTLD_DL_LINKMAP) == 0) return {};
  const auto* const loaded = static_cast<const link_map*>(found);
  // The loader stores a program's call name, perhaps a word looked up on PATH.
  const bool program = loaded == nullptr || loaded->l_name == nullptr || loaded->l_name[0] == '\0';
  const fs::path file = program ? fs::path("/proc/self/exe") : fs::path(object.dli_fname);
  fs::path folder = fs::canonical(file, failure).parent_path();
  // Copies for a processor level are in FOLDER/glibc-hwcaps/LEVEL/, the parts in FOLDER.
  if (folder.parent_path().filename() == "glibc-hwcaps") folder = folder.parent_path().parent_path();
  return {std::move(folder), program};
}

bool is_below(const fs::path& folder, const fs::path& top) {
  const fs::path relative = folder.lexically_relative(top);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::vector<fs::path> part_places(const LoadedPart& part) {
  const std::string file = "asperity-" + std::string(part.name) + ".so";
  std::vector<fs::path> places;
  // Unknown without /proc.
  if (const Own own = own_object(); !own.folder.empty()) {
    places.push_back(own.folder / file);
    // From bin/ or lib/lua/5.4/ to lib/asperity/.
    places.push_back(
        (own.folder / (own.program ? "../lib/asperity" : "../../asperity") / file).lexically_normal());
    std::error_code failure;
    const fs::path build = fs::canonical(ASPERITY_BUILD_FOLDER, failure);
    if (!failure && own.folder != build && is_below(own.folder, build)) places.push_back(build / file);
  }
  // For other programs linked with the library.
  const fs::path installed = fs::path(ASPERITY_PARTS_FOLDER) / file;
  if (std::ranges::find(places, installed) == places.end()) places.push_back(installed);
  return places;
}

void* part_symbol(const LoadedPart& part, const char* symbol) {
  // Cached: a confined process no longer sees the files.
  static std::mutex mutex;
  static std::map<std::pair<std::string, std::string>, void*> found;
  const std::lock_guard lock(mutex);
  void*& address = found[{std::string(part.name), symbol}];
  if (address == nullptr) address = part_symbol(part, symbol, part_places(part));
  return address;
}

void* part_symbol(const LoadedPart& part, const char* symbol, const std::vector<fs::path>& places) {
  std::vector<std::string> searched;
  for (const fs::path& place : places) {
    std::error_code failure;
    if (!fs::exists(place, failure)) {
      searched.push_back(quoted(place.string()));
      continue;
    }
    // The handle is never closed.
    void* const handle = ::dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr)
      refuse_bad_file(std::string(part.purpose) + " by " + quoted(place.string()) +
                          ", which cannot be loaded: " + ::dlerror(),
                      "install Debian's package " + std::string(part.package));
    if (void* const address = ::dlsym(handle, symbol); address != nullptr) return address;
    refuse_bad_file(std::string(part.purpose) + " by " + quoted(place.string()) +
                        ", a file of another version: it has no " + quoted(symbol),
                    "build or install the program and its parts together");
  }
  refuse_bad_file(std::string(part.purpose) + " by asperity-" + std::string(part.name) +
                      ".so, a file that is missing; looked for " + joined(searched, " and "),
                  "build or install the whole program, with Debian's package " + std::string(part.package));
}

}  // namespace asperity
