// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>

#include "control/order.h"
#include "instruments/samples.h"
#include "pipeline/battery.h"
#include "pipeline/navigation.h"

namespace navcal::record {

/// Topic and times of one JSON message of the log. Log files and the status socket share it and the payload, so
/// they agree to the byte.
struct MessageHead {
  std::uint16_t topic = 0;       ///< number of log_topics.h; 0: this has no message
  std::int64_t time_ns = 0;      ///< monotonic: when it became known
  std::int64_t validity_ns = 0;  ///< monotonic: the instant that it is about
};

/// Satellites in view have no message: the raw bytes have them.
[[nodiscard]] MessageHead head_of(const instruments::Sample& sample);
[[nodiscard]] MessageHead head_of(const pipeline::NavigationSample& sample);
[[nodiscard]] MessageHead head_of(const pipeline::BatterySample& sample);
/// `now_ns` monotonic: when the outcome of the order was known.
[[nodiscard]] MessageHead head_of(const control::OrderRecord& record, std::int64_t now_ns);

/// Puts the CRC-32C of the object that begins at `begin` in place of its closing brace: `,"crc":"1a2b3c4d"}`.
void append_sum(std::string& out, std::size_t begin);

/// Appends one payload. `append(out)` writes one JSON object.
template <class Append>
void append_payload(std::string& out, Append&& append) {
  const std::size_t begin = out.size();
  append(out);
  assert(out.size() > begin + 2 && out.back() == '}');
  append_sum(out, begin);
}

}  // namespace navcal::record
