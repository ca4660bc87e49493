// SPDX-License-Identifier: Apache-2.0
#include "analysis/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <system_error>

namespace navcal::analysis {
namespace {

/// Ten thousand times a run of ten seconds.
constexpr std::uintmax_t kLargestRunFile = 200'000'000;

std::string content_of_run(const std::filesystem::path& file) {
  if (std::filesystem::file_size(file) > kLargestRunFile) {
    throw runs::BadRun(file.string() + ": too large for a run");
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) {
    throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), file.string());
  }
  return content;
}

}  // namespace

std::vector<runs::Run> read_run_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  if (files.empty()) throw runs::BadRun(folder.string() + ": no run files (.csv)");
  std::ranges::sort(files);
  std::map<std::string, std::filesystem::path> named;
  std::vector<runs::Run> read;
  for (const auto& file : files) {
    const std::string name = file.stem().string();
    const auto [known, fresh] = named.emplace(name, file);
    if (!fresh) {
      throw runs::BadRun(fmt::format("{}: another run is named so: {}", file.string(), known->second.string()));
    }
    read.push_back(runs::read_run(content_of_run(file), name, file.string()));
  }
  return read;
}

}  // namespace navcal::analysis
