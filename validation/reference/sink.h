// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "validation/reference/snapshot.h"

namespace navcal::reference {

enum class Port : std::uint8_t { compass, imu, gps, motor, doppler, actuators };

/// Entry for one port in the header of a recording.
struct PortFacts {
  std::string_view name, protocol;
  int baud;
};
inline constexpr std::array<PortFacts, 6> kPorts{{{"compass", "tcm2", 38400},
                                                  {"imu", "imu-card", 57600},
                                                  {"gps", "oncore", 9600},
                                                  {"motor", "motor-card", 19200},
                                                  {"doppler", "waterlinked", 115200},
                                                  {"actuators", "described", 115200}}};
/// Of the vehicle with one propeller and three fins.
inline constexpr std::array kFinnedPorts{Port::compass, Port::imu, Port::gps, Port::motor};
/// Of vehicles with thrusters.
inline constexpr std::array kThrusterPorts{Port::compass, Port::imu, Port::gps, Port::doppler, Port::actuators};
[[nodiscard]] constexpr const PortFacts& facts_of(Port port) { return kPorts[static_cast<std::size_t>(port)]; }

/// Bytes that the vehicle's computer read from a port, or wrote to it.
struct Transfer {
  Port port = Port::compass;
  bool sent = false;         ///< by the computer
  std::int64_t time_ns = 0;  ///< UTC: the last of them was read, or the writing began
  std::vector<std::uint8_t> bytes;
};

/// Destination of a run. This room opens no files: the caller writes the recording.
class Sink {
 public:
  virtual ~Sink() = default;
  /// In order of time.
  virtual void transfer(const Transfer& transfer) = 0;
  /// The true state, ten times a second; no diagnosis may see it.
  virtual void truth(const Snapshot& /*snapshot*/) {}
};

/// Transfers of all ports, brought into one order.
class Outbox {
 public:
  explicit Outbox(Sink& sink) : sink_(sink) {}
  [[nodiscard]] std::vector<Transfer>& waiting() { return waiting_; }
  void hand_over(std::int64_t to_ns) {
    const auto earlier = [](const Transfer& a, const Transfer& b) { return a.time_ns < b.time_ns; };
    std::stable_sort(waiting_.begin(), waiting_.end(), earlier);
    auto next = waiting_.begin();
    for (; next != waiting_.end() && next->time_ns <= to_ns; ++next) sink_.transfer(*next);
    waiting_.erase(waiting_.begin(), next);
  }

 private:
  Sink& sink_;
  std::vector<Transfer> waiting_;
};

}  // namespace navcal::reference
