// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "calib/suite/calibrator_unit.h"

namespace navcal::calib::test {

/// A calibrator as a newcomer would write it: the mean pitch of the compass, taken off the heading.
class MeanPitch final : public CalibratorUnit {
 public:
  void update_compass(const CompassReading& reading) override {
    if (!reading.pitch_rad) return;
    sum_rad_ += *reading.pitch_rad;
    ++readings_;
  }
  void start() override { sum_rad_ = readings_ = 0; }
  void put_estimate(Correction& into) const override {
    const std::array value{readings_ > 0 ? sum_rad_ / readings_ : 0};
    put_added(into, readings_ > 0 ? std::span<const double>(value) : std::span<const double>());
  }
  [[nodiscard]] Judgement judgement() const override {
    Judgement judgement;
    judgement.accepted = readings_ > kEnough;
    if (!judgement.accepted) judgement.reason = "too few readings of the pitch";
    return judgement;
  }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    if (readings_ == 0) return {};
    return {{"mean_rad", sum_rad_ / readings_, 0.001}};
  }
  void archive(Archive& archive) override { archive(sum_rad_, readings_); }

  static constexpr double kEnough = 50;

 private:
  double sum_rad_ = 0, readings_ = 0;
};

inline constexpr std::array<std::string_view, 1> kMeanPitchNames{"mean_rad"};
inline constexpr CalibratorRow kMeanPitch{
    .name = "mean_pitch",
    .title = "Mean pitch",
    .needs = {.compass = true},
    .needs_text = "a compass with an inclinometer",
    .value_names = kMeanPitchNames,
    .apply = [](std::span<const double> value, const CompassReading&,
                double heading_rad) { return heading_rad - value.front(); },
    .make = [](const SuiteOptions&, SharedEstimators&) -> std::unique_ptr<CalibratorUnit> {
      return std::make_unique<MeanPitch>();
    }};

}  // namespace navcal::calib::test
