// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "protocols/frame.h"

namespace navcal::sim {

inline constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

/// Bytes that a device sends in one go.
struct Emission {
  std::int64_t start_ns = 0;  ///< the first bit is on the wire
  std::vector<std::uint8_t> bytes;
};

/// Behaviour of one instrument behind its serial line: no port, no clock. Times are UTC nanoseconds and never
/// decrease. The caller calls advance() at next_event_ns() and passes on the bytes of the host.
class Device {
 public:
  virtual ~Device() = default;
  /// Power comes (again): all that a device does not keep is forgotten.
  virtual void power_on(std::int64_t t_ns) = 0;
  /// The last of these bytes has arrived at t_ns.
  virtual void on_bytes(std::int64_t t_ns, protocols::Bytes bytes) = 0;
  /// Time of its next own action; kNever_ns while it waits for its host.
  [[nodiscard]] virtual std::int64_t next_event_ns() const = 0;
  /// Does what is due up to t_ns and appends what it sends for it.
  virtual void advance(std::int64_t t_ns, std::vector<Emission>& out) = 0;
  /// Speed of its line now.
  [[nodiscard]] virtual int baud() const = 0;
};

/// A serial line carries one byte after the other: what is sent while it is busy waits.
class Line {
 public:
  void put(std::int64_t t_ns, int baud, std::vector<std::uint8_t> bytes, std::vector<Emission>& out) {
    const std::int64_t start_ns = t_ns > free_ns_ ? t_ns : free_ns_;
    free_ns_ = start_ns + static_cast<std::int64_t>(bytes.size()) * 10'000'000'000 / baud;
    out.push_back({start_ns, std::move(bytes)});
  }
  [[nodiscard]] std::int64_t free_ns() const { return free_ns_; }

 private:
  std::int64_t free_ns_ = 0;
};

}  // namespace navcal::sim
