// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "protocols/oncore_command.h"
#include "sim/instruments/device.h"
#include "sim/instruments/gps_receiver.h"

namespace navcal::sim {

/// Motorola Oncore (ICD section 2): silent until asked, reads its input once a second, sends some time after
/// the second that its messages state. With 12 channels it takes position and time from its host. Nothing that was
/// asked for outlives a loss of power.
class Oncore final : public LineDevice {
 public:
  enum class Kind : std::uint8_t {
    twelve_channels,  ///< supports Ha and Ea
    eight_channels,   ///< supports Ea and does not answer a request for Ha
    nmea,             ///< today's receiver: sentences every second without being asked, deaf to commands
  };
  struct Options {
    GpsReceiver::Options receiver;  ///< with the latency of the messages
    Kind kind = Kind::twelve_channels;
    int leap_seconds = 18;
    bool leap_seconds_known = true;  ///< else it reports GPS time, as after a cold start
    int weeks_early = 0;             ///< of a date that has rolled over: 1024 or 2048
    std::uint64_t seed = 1;
    int baud = 9600;
  };
  Oncore(const Options& options, const Motion& motion);

  void power_on(std::int64_t t_ns) override;
  void on_bytes(std::int64_t t_ns, protocols::Bytes bytes) override;

 private:
  /// A message that was asked for.
  struct Request {
    std::uint8_t every_s = 0;  ///< 0: once
    std::uint8_t wait_s = 0;   ///< seconds until it is due
  };
  [[nodiscard]] std::int64_t next_act_ns() const override { return second_ns_ + latency_ns(); }
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  [[nodiscard]] std::int64_t latency_ns() const;
  [[nodiscard]] bool knows(protocols::FrameId id) const;
  void read_input(std::vector<Emission>& out);
  /// Position or time from the host; the answer is the command itself.
  void take_aid(protocols::Bytes frame, std::vector<Emission>& out);
  /// Empty when this message is not one of this receiver.
  [[nodiscard]] std::vector<std::uint8_t> message(protocols::FrameId id, const GpsReading& reading) const;

  Options options_;
  GpsReceiver receiver_;
  std::vector<std::uint8_t> input_;
  protocols::oncore::CommandParser parser_;
  std::map<protocols::FrameId, Request> requests_;
  std::int64_t second_ns_ = 0;
};

}  // namespace navcal::sim
