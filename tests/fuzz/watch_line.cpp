// SPDX-License-Identifier: Apache-2.0
// Lines of the status socket as `navcal gap watch` reads them: each is passed over, taken or counted as bad.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "gap/watch/live_records.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::watch_line_target {

NAVCAL_FUZZ(watch_line) {
  using namespace navcal::gap;
  // Most inputs get the head that a record needs, so that the fuzzer finds the rest of it.
  std::string text(reinterpret_cast<const char*>(data), size);
  if (size > 0 && data[0] % 4 != 0)
    text = R"({"class":"RECORD","topic":"/imu","device":"imu","time":)" + text.substr(1);
  LiveRecords records;
  std::uint64_t lines = 0;
  for (std::size_t begin = 0; begin <= text.size(); ++lines) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    records.take(std::string_view(text).substr(begin, end - begin), nullptr);
    begin = end + 1;
  }
  if (records.bad() > lines || records.samples() > lines) std::abort();
  if (const auto& field = records.field(); field && !(std::abs(field->north_east_down_uT[2]) < 100)) std::abort();
  return 0;
}

}  // namespace navcal::fuzz::watch_line_target
