// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "config/settings.h"
#include "instruments/samples.h"
#include "pipeline/battery.h"
#include "pipeline/battery_estimator.h"
#include "pipeline/navigation.h"
#include "pipeline/pipeline.h"
#include "pipeline/utc_mapping.h"

namespace navcal::pipeline {

/// Between samples and the estimator of the battery's charge: feeds it with the motor's current, the gauge's
/// readings and the speed, tells the sink at the interval of the configuration, and judges when the battery is
/// low.
class BatteryStage {
 public:
  /// Null when the configuration says not to.
  static std::unique_ptr<BatteryStage> make(const config::Settings& settings);
  explicit BatteryStage(const config::BatterySettings& settings);

  /// The sink must have had the sample.
  void take(const instruments::Sample& sample, const std::optional<NavigationSample>& navigation,
            const UtcMapping& mapping, Sink& sink);
  void set(const BatteryCharge& charge) { estimator_.set(charge); }
  /// Nullopt before a sample of the battery or the motor came.
  [[nodiscard]] const std::optional<BatterySample>& newest() const { return newest_; }

 private:
  void feed(const instruments::Sample& sample);
  void judge(const instruments::Sample& sample, Sink& sink);
  void tell(const instruments::Sample& trigger, const UtcMapping& mapping, Sink& sink);

  config::BatterySettings settings_;
  std::int64_t interval_ns_;
  BatteryEstimator estimator_;
  std::optional<std::uint16_t> port_;  ///< of the battery's gauge, else of the motor card
  bool has_gauge_ = false;
  std::optional<std::int64_t> below_since_ns_;  ///< the voltage is below its limit
  bool low_ = false;
  std::uint16_t low_port_ = 0;
  std::int64_t told_ = 0;  ///< intervals of the monotonic clock
  std::optional<BatterySample> newest_;
};

}  // namespace navcal::pipeline
