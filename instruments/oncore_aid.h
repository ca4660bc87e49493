// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/frame.h"
#include "protocols/oncore_command.h"

namespace navcal::instruments {

/// What a receiver can be given: where the vehicle is thought to be, and UTC, nanoseconds since 1970.
struct ReceiverAid {
  protocols::oncore::AidPosition position;
  std::int64_t utc_ns = 0;
};

/// When a 12-channel Oncore is to be given position and time: once after its messages began or began again, if its
/// status says that it makes a cold start (time, position or almanac unknown) and it has no fix. A state machine
/// without I/O or clock.
class OncoreAid {
 public:
  /// The port was opened, or opened anew.
  void begin();
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns);
  [[nodiscard]] bool wanted() const { return wanted_; }
  /// The commands, to be sent in this order; wanted() is false from then on.
  [[nodiscard]] std::vector<std::vector<std::uint8_t>> give(const ReceiverAid& aid);

 private:
  bool wanted_ = false, decided_ = false;  ///< decided: given, or not needed, since the messages began
  std::optional<std::int64_t> newest_ns_;  ///< of the positions
};

}  // namespace navcal::instruments
