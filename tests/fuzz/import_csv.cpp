// SPDX-License-Identifier: Apache-2.0
// The bytes before the first zero are the map, those behind it the file.
#include "analysis/import/log_readers.h"
#include "config/error.h"
#include "record/recording.h"
#include "tests/fuzz/import_sink.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::import_csv_target {

NAVCAL_FUZZ(import_csv) {
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t zero = std::min(all.find('\0'), all.size());
  const std::string_view file = all.substr(std::min(zero + 1, all.size()));
  try {
    const auto map = navcal::config::parse_csv_map(all.substr(0, zero), "map");
    navcal::fuzz::CheckingSink sink;
    navcal::fuzz::require_within(navcal::analysis::read_csv(file, map, sink), file.size());
  } catch (const navcal::config::Error&) {
  } catch (const navcal::record::BadRecording&) {
  }
  return 0;
}

}  // namespace navcal::fuzz::import_csv_target
