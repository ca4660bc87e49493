// SPDX-License-Identifier: Apache-2.0
// Any bytes as the description of a device: problems, or a description that finds and reads frames in any bytes.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "config/described/description_file.h"
#include "protocols/described/reading.h"
#include "protocols/described/scanner.h"
#include "tests/fuzz/target.h"
#include "tests/protocols/described_encode.h"

namespace navcal::fuzz::description_target {

NAVCAL_FUZZ(description) {
  using namespace navcal;
  std::vector<config::Problem> problems;
  const auto device = config::read_description({reinterpret_cast<const char*>(data), size}, problems);
  if (!problems.empty()) return 0;
  protocols::described::Parser parser{protocols::described::Scanner(protocols::described::compile(device))};
  const auto read = [&](const protocols::Frame& frame) {
    for (const auto& kind : device.kinds) {
      if (kind.id != frame.id) continue;
      std::vector<double> values(kind.fields.size());
      (void)protocols::described::FrameReader(kind, device.is_text).read(frame.bytes, values);
    }
  };
  parser.feed({data, size}, read);
  for (const auto& kind : device.kinds) {
    const std::vector<double> values(kind.fields.size(), 1.0);
    parser.feed(encode(device, kind, values), read);
  }
  while (parser.held() > 0) parser.silence(read);
  const auto& counters = parser.counters();
  if (counters.bytes != counters.framed_bytes + counters.skipped_bytes) std::abort();
  return 0;
}

}  // namespace navcal::fuzz::description_target
