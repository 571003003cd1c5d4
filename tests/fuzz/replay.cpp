// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a target over folders of files, for builds without libFuzzer. After a failure, the last printed name
// is the file:
//
//   PROGRAM --target=NAME FOLDER..
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int count, char** arguments) {
  namespace fs = std::filesystem;
  LLVMFuzzerInitialize(&count, &arguments);
  std::vector<fs::path> files;
  for (int k = 1; k < count; ++k) {
    if (std::string(arguments[k]).starts_with("--")) continue;
    const fs::path place(arguments[k]);
    if (!fs::is_directory(place))
      files.push_back(place);
    else
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(place))
        if (entry.is_regular_file()) files.push_back(entry.path());
  }
  if (files.empty()) {
    std::fprintf(stderr, "no file to run\n");
    return 1;
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::fprintf(stderr, "%s\n", file.c_str());
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%zu files\n", files.size());
  return 0;
}
