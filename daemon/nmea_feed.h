// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "daemon/state_report.h"
#include "daemon/status_server.h"
#include "instruments/samples.h"
#include "pipeline/navigation.h"
#include "pipeline/pipeline.h"
#include "protocols/nmea_vehicle.h"

namespace navcal::daemon {

/// Sends NMEA 0183 sentences to the clients of the status socket that ask for them (docs/status-protocol.md).
/// Positions are those of the receiver that serves, or the estimate while no fix is current. Everything else is
/// the state of the vehicle, on each word of the compass that serves. Nothing is written while nobody asks.
class NmeaFeed {
 public:
  NmeaFeed(const config::Settings& settings, const pipeline::Pipeline& pipeline, StatusServer& server);

  /// Of a receiver: position or satellites.
  void sample(const instruments::Sample& sample);
  void navigation(const pipeline::NavigationSample& sample);
  /// True when any client wants sentences about the vehicle now. `port`: of the compass that serves; absent: there
  /// is none.
  [[nodiscard]] bool wants_vehicle(std::optional<std::uint16_t> port) const;
  /// `compass`: the word of that compass; null without one.
  void vehicle(std::optional<std::uint16_t> port, const instruments::CompassSample* compass,
               const VehicleState& state);

 private:
  void position(const instruments::Sample& sample, const instruments::GpsSample& gps);
  void satellites(std::uint16_t port, const instruments::SkySample& sky);
  [[nodiscard]] bool serves(std::uint16_t port) const;
  [[nodiscard]] std::optional<double> variation_deg() const;
  [[nodiscard]] NmeaKey vehicle_key(std::optional<std::uint16_t> port) const;
  void append_headings(const instruments::CompassSample* compass, const VehicleState& state);

  const config::Settings& settings_;
  const pipeline::Pipeline& pipeline_;
  StatusServer& server_;
  std::vector<std::vector<std::uint16_t>> used_;  ///< satellites of each port, as it said last
  bool is_reckoned_ = false;                      ///< no fix is current, but there is an estimate
  std::string sentences_;
};

}  // namespace navcal::daemon
