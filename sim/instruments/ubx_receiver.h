// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "protocols/ubx_configuration.h"
#include "sim/instruments/device.h"
#include "sim/instruments/gps_receiver.h"

namespace navcal::sim {

/// u-blox receiver (ICD section 6). As delivered it sends NMEA at 1 Hz; it is configured by its host and forgets
/// all of that with its power. Its epochs are those of its own clock, which is some microseconds off; NAV-PVT
/// states that. It states the errors that its noise has.
class UbxReceiver final : public CommandedDevice<protocols::ubx::Parser> {
 public:
  enum class Generation : std::uint8_t {
    six,    ///< has no NAV-PVT: refuses CFG-MSG for it
    eight,  ///< refuses CFG-VALSET, takes CFG-MSG and CFG-RATE
    nine,   ///< takes CFG-VALSET
  };
  struct Options {
    GpsReceiver::Options receiver;  ///< with the latency of the messages
    Generation generation = Generation::nine;
    protocols::ubx::ReceiverPort port = protocols::ubx::ReceiverPort::uart1;  ///< at which its host is
    std::int64_t clock_error_ns = -231'000;                                   ///< of its epochs
    int leap_seconds = 18;
    std::uint64_t seed = 1;
    int baud = 38400;
  };
  UbxReceiver(const Options& options, const Motion& motion);

  void power_on(std::int64_t t_ns) override;

 private:
  using MessageCode = protocols::ubx::MessageCode;

  /// What the host sets; in the receiver's RAM.
  struct Configuration {
    std::map<MessageCode, std::uint8_t> epochs;  ///< between two of a message on this port; 0: never
    std::int64_t interval_ns = 1'000'000'000;
    bool nmea = true, ubx = true;
  };

  [[nodiscard]] std::int64_t next_act_ns() const override { return epoch_ns_ + latency_ns(); }
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  void obey(std::int64_t t_ns, const protocols::Frame& command) override;
  bool set(const protocols::ubx::ValueSet& values);
  bool set(const protocols::ubx::MessageRate& rate);
  [[nodiscard]] std::vector<std::uint8_t> message(MessageCode code, const GpsReading& reading) const;
  [[nodiscard]] std::int64_t latency_ns() const;

  Options options_;
  GpsReceiver receiver_;
  Configuration configuration_;
  std::int64_t epoch_ns_ = 0;  ///< the next one
  std::uint64_t epochs_ = 0;
  bool ever_fixed_ = false;
};

}  // namespace navcal::sim
