// SPDX-License-Identifier: Apache-2.0
// Writes logs for tests/mcap/read.mjs into a folder: finished, unfinished, with a tail of
// zeros (some file systems leave one), and repaired.
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "record/log/log_folder.h"
#include "record/log/log_repair.h"
#include "tests/record/sample_log.h"

namespace {

using namespace navcal::record;

bool write(const std::filesystem::path& path, std::string_view bytes, bool finish) {
  std::error_code error;
  const auto file = LogFile::create(real_disk(), path, error);
  if (!file || file->append(bytes) || file->sync()) return false;
  return !finish || !file->finish();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  constexpr int kSeconds = 5;  // some more than the 64 KiB that are cut
  const auto finished = testing::sample_log(kSeconds, true);
  // Damaged in the middle and cut short; then repaired.
  std::string damaged = testing::sample_log(kSeconds, false).bytes;
  damaged[finished.ends[20] + 1] = '\x7F';
  damaged.resize(damaged.size() - 11);
  if (!write(folder / "finished.mcap", finished.bytes, true) ||
      !write(folder / "unfinished.mcap", testing::sample_log(kSeconds, false).bytes, false) ||
      !write(folder / "zero_tail.mcap", testing::sample_log(kSeconds, false).bytes + std::string(100'000, '\0'),
             false) ||
      !write(folder / "repaired.mcap", damaged, false)) {
    std::perror("write_sample_log");
    return 1;
  }
  const Repair repair = finish_log(real_disk(), folder / "repaired.mcap");
  std::printf("%s\n", repair.message().c_str());
  return repair.error ? 1 : 0;
}
