// SPDX-License-Identifier: Apache-2.0
#include "tests/sim/drive.h"

#include <gtest/gtest.h>

namespace navcal::sim::testing {

std::vector<Emission> run_to(Device& device, std::int64_t t_ns) {
  std::vector<Emission> out;
  std::int64_t last_ns = 0;
  while (device.next_event_ns() <= t_ns) {
    const std::int64_t event_ns = device.next_event_ns();
    EXPECT_GE(event_ns, last_ns) << "events never go back";
    last_ns = event_ns;
    device.advance(event_ns, out);
  }
  std::int64_t free_ns = 0;
  for (const Emission& emission : out) {
    EXPECT_GE(emission.start_ns, free_ns) << "two at once on one line";
    free_ns =
        emission.start_ns + static_cast<std::int64_t>(emission.bytes.size()) * 10 * kSecond_ns / device.baud();
  }
  return out;
}

std::string say(Device& device, std::int64_t& t_ns, std::string_view line, double seconds) {
  device.on_bytes(t_ns, bytes_of(line));
  t_ns += static_cast<std::int64_t>(seconds * 1e9);
  return text_of(run_to(device, t_ns));
}

std::string text_of(const std::vector<Emission>& emissions) {
  std::string text;
  for (const Emission& emission : emissions) text.append(emission.bytes.begin(), emission.bytes.end());
  return text;
}

protocols::Bytes bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace navcal::sim::testing
