// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "config/settings.h"
#include "daemon/state_report.h"
#include "instruments/samples.h"
#include "pipeline/pipeline.h"

namespace navcal::daemon {

/// Spread of readings about an estimate: root mean square, older ones forgotten.
class Spread {
 public:
  void add(double difference);
  /// Nullopt before ten have come.
  [[nodiscard]] std::optional<double> std() const;

 private:
  double mean_square_ = 0;
  std::uint64_t count_ = 0;
};

/// The state of the vehicle at any instant, from the newest samples of the instruments that serve and the estimate
/// of the pipeline. Taking a sample costs a copy; everything else is done when a state is asked for.
class StateCollector {
 public:
  StateCollector(const config::Settings& settings, const pipeline::Pipeline& pipeline);

  void take(const instruments::Sample& sample);
  /// Carried to `now_ns`, monotonic. Depth and attitude are carried by at most half a second.
  [[nodiscard]] VehicleState at(std::int64_t now_ns);
  /// True when a sample comes from the compass in use.
  [[nodiscard]] bool is_serving_compass(const instruments::Sample& sample) const;
  /// The heading is by a "calibration", by the "device" itself, or the estimate of an "autopilot"; empty: none.
  [[nodiscard]] std::string_view heading_source() const;

 private:
  template <class Value>
  struct Newest {
    instruments::Stamp stamp;
    Value value;
    std::uint16_t port;  ///< without a default value: clang 14 crashes on one in a template within a class
  };
  struct Last {
    std::optional<Newest<instruments::CompassSample>> compass;
    std::optional<Newest<instruments::ImuSample>> imu;
    std::optional<Newest<instruments::MotorSample>> motor;
    std::optional<Newest<instruments::GpsSample>> fix;
  };
  /// How far the depth gauge of a port lies below the vehicle's origin, at the attitude of the estimate.
  [[nodiscard]] double gauge_below_origin_m(std::uint16_t port) const;
  /// Newest readings of the devices in use.
  [[nodiscard]] Last serving() const;
  void take_estimate(VehicleState& state, const Last& last, std::int64_t now_ns);
  void take_battery(VehicleState& state) const;
  void take_compass(VehicleState& state, const Last& last) const;

  const config::Settings& settings_;
  const pipeline::Pipeline& pipeline_;
  std::vector<Last> last_;
  Spread pitch_, depth_;
  std::int64_t pitch_ns_ = 0, depth_ns_ = 0;  ///< of the readings that were compared last
};

}  // namespace navcal::daemon
