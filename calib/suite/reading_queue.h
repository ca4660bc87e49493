// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "calib/archive.h"
#include "calib/readings.h"

namespace navcal::calib {

enum class Stream : std::uint8_t { compass, rate, ground, motor };
inline constexpr std::size_t kStreams = 4;

/// A reading of any instrument; the alternatives are in the order of Stream.
using Reading = std::variant<CompassReading, RateReading, GroundReading, MotorReading>;
[[nodiscard]] inline Stream stream_of(const Reading& reading) {
  if (reading.valueless_by_exception()) throw std::bad_variant_access();  // as std::visit does
  return static_cast<Stream>(reading.index());
}
[[nodiscard]] double time_of(const Reading& reading);
void set_time(Reading& reading, double time_s);

void archive(Archive& archive, CompassReading& reading);

struct QueuedReading {
  double key_s = 0;  ///< its place in the order
  Reading reading;
  bool field_frozen = false, heading_frozen = false, rate_frozen = false;
  void archive(Archive& archive);
};

/// Readings waiting in the order of their keys, those with equal keys in the order in which they came. Memory is
/// taken once.
class ReadingQueue {
 public:
  static constexpr std::size_t kCapacity = 1024;

  ReadingQueue() : entries_(kCapacity) {}
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] bool full() const { return count_ == kCapacity; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] QueuedReading& front() { return entries_[first_]; }
  void pop();
  /// Must not be full. The entry stays where it is until the next push or pop.
  QueuedReading& push(double key_s, const Reading& reading);
  /// Visits entries from the newest key backwards; `visit` returns false to end.
  template <class Visit>
  void visit_backwards(Visit visit) {
    for (std::size_t i = count_; i > 0 && visit(at(i - 1)); --i) {
    }
  }
  void archive(Archive& archive);

 private:
  [[nodiscard]] QueuedReading& at(std::size_t i) { return entries_[(first_ + i) % kCapacity]; }

  std::vector<QueuedReading> entries_;  ///< a ring
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace navcal::calib
