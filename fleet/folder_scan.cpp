// SPDX-License-Identifier: Apache-2.0
#include "fleet/folder_scan.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <system_error>

#include "analysis/failure.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

bool is_recording(const fs::path& file) { return file.extension() == ".cap" || file.extension() == ".mcap"; }

}  // namespace

fs::path FolderScan::vehicle_of(const fs::path& file) const {
  for (fs::path folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    if (const auto found = vehicles.find(folder); found != vehicles.end()) return found->second;
  }
  return {};
}

bool look_at(RecordingFile& file) {
  struct stat status {};
  if (::stat(file.path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  file.bytes = status.st_size;
  file.modified_ns = status.st_mtim.tv_sec * kNanoseconds + status.st_mtim.tv_nsec;
  return true;
}

FolderScan scan(const fs::path& folder) {
  FolderScan found;
  std::error_code error;
  const fs::path whole = fs::canonical(folder, error);
  fs::recursive_directory_iterator at(whole, error);
  for (const fs::recursive_directory_iterator end; !error && at != end; at.increment(error)) {
    const fs::path& path = at->path();
    std::error_code unreadable;
    if (path.filename().string().starts_with('.') || fs::exists(catalogue_of(path), unreadable)) {
      at.disable_recursion_pending();
      continue;
    }
    if (path.filename() == "vehicle.toml") found.vehicles[path.parent_path()] = path;
    RecordingFile file{path.string(), 0, 0, {}};
    if (is_recording(path) && look_at(file)) found.files.push_back(std::move(file));
  }
  if (error) throw analysis::Failure(analysis::Exit::bad_input, folder.string() + ": " + error.message());
  std::sort(found.files.begin(), found.files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return found;
}

}  // namespace navcal::fleet
