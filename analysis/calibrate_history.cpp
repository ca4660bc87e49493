// SPDX-License-Identifier: Apache-2.0
#include "analysis/calibrate_history.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "base/angles.h"
#include "pipeline/readings.h"

namespace navcal::analysis {
namespace {

/// Readings of the compass that wait for the gyro; more wait in vain.
constexpr std::size_t kMostPending = 64;

/// Two that followed each other as one.
TurnedSample joined(const TurnedSample& first, const TurnedSample& second) {
  TurnedSample both = second;
  both.has_turn = first.has_turn && second.has_turn;
  both.measured_rad += first.measured_rad;
  both.bias_time_s += first.bias_time_s;
  both.tilt_rad += first.tilt_rad;
  return both;
}

}  // namespace

CalibrateHistory::CalibrateHistory(const config::Settings& settings)
    : ports_(pipeline::calibrated_ports(settings)), sources_(settings),
      gate_(pipeline::suite_options(settings, ports_).gate),
      turns_({.tilt_lag_s = settings.instruments.compass.tilt_lag_s,
              .tilt_noise_rad = pipeline::reckoned_noise(settings).tilt_rad}) {}

double CalibrateHistory::seconds(const instruments::Sample& sample) {
  if (!origin_ns_) origin_ns_ = sample.stamp.validity_ns;
  return static_cast<double>(sample.stamp.validity_ns - *origin_ns_) * 1e-9;
}

void CalibrateHistory::on_sample(const instruments::Sample& sample) {
  (void)sources_.take(sample);
  if (const auto* compass = std::get_if<instruments::CompassSample>(&sample.value)) {
    if (sources_.learnt().compass != sample.port || !pipeline::is_reading_of_compass(*compass)) return;
    ++readings_;
    put(pipeline::calib_reading(*compass, sample.stamp, seconds(sample)));
  } else if (const auto* imu = std::get_if<instruments::ImuSample>(&sample.value)) {
    if (sample.port != ports_.imu) return;
    if (const auto reading = pipeline::calib_reading(*imu, sample.stamp, seconds(sample))) put(*reading);
  } else if (const auto* motor = std::get_if<instruments::MotorSample>(&sample.value)) {
    if (sample.port == ports_.motor && (motor->rpm || motor->current_A))
      put(calib::MotorReading{seconds(sample), motor->rpm, motor->current_A});
  }
}

void CalibrateHistory::put(const calib::Reading& reading) {
  gate_.put(reading);
  take_cleaned();
}

void CalibrateHistory::begin_recording() {
  gate_.restart();
  origin_ns_.reset();
}

void CalibrateHistory::finish(const pipeline::Pipeline& pipeline) {
  gate_.flush();
  take_cleaned();
  take_turned(true);
  next_look_ = 0;
  look(pipeline);
}

void CalibrateHistory::take_cleaned() {
  while (const auto clean = gate_.take()) {
    if (const auto* compass = std::get_if<calib::CompassReading>(&*clean)) {
      newest_s_ = compass->time_s;
      pending_.push_back(*compass);
      turns_.update(*compass);
    } else if (const auto* rate = std::get_if<calib::RateReading>(&*clean)) {
      turns_.update(*rate);
    }
    take_turned(false);
  }
}

void CalibrateHistory::take_turned(bool to_the_end) {
  while (!pending_.empty()) {
    if (!turn_) turn_ = turns_.next();
    const double time_s = pending_.front().time_s;
    if (!turn_ && pending_.size() < kMostPending && !to_the_end) return;
    if (turn_ && turn_->time_s < time_s) {
      turn_.reset();  // of a reading that was given up
      continue;
    }
    TurnedSample sample;
    sample.reading = pending_.front();
    pending_.pop_front();
    if (turn_ && turn_->time_s <= time_s) {
      const calib::TurnStep turn = *std::exchange(turn_, std::nullopt);
      sample.has_turn = !turn.begins_segment;
      sample.measured_rad = turn.measured_angle_rad;
      sample.bias_time_s = turn.bias_time_s;
      sample.tilt_rad = turn.tilt_angle_rad;
    }
    keep(sample);
  }
}

void CalibrateHistory::keep(const TurnedSample& sample) {
  if (samples_.empty() || readings_in_last_ == readings_per_sample_) {
    samples_.push_back(sample);
    readings_in_last_ = 1;
  } else {
    samples_.back() = joined(samples_.back(), sample);
    ++readings_in_last_;
  }
  if (samples_.size() < kMostSamples || readings_in_last_ < readings_per_sample_) return;
  for (std::size_t i = 0; i + 1 < samples_.size(); i += 2) samples_[i / 2] = joined(samples_[i], samples_[i + 1]);
  samples_.resize(samples_.size() / 2);
  readings_per_sample_ *= 2;
  readings_in_last_ = readings_per_sample_;
}

void CalibrateHistory::look(const pipeline::Pipeline& pipeline) {
  if (readings_ < next_look_) return;
  next_look_ = readings_ + look_every_;
  bool full = false;
  for (const auto& calibrator : pipeline.calibration_report().calibrators) {
    for (const auto& quantity : calibrator.estimate) {
      std::string name(calib::name_of(calibrator.calibrator));
      auto& points = estimates_[name.append(".").append(quantity.name)];
      points.push_back({newest_s_, quantity.value, quantity.std});
      full = full || points.size() >= kMostPoints;
    }
  }
  if (full) thin_estimates();
}

void CalibrateHistory::thin_estimates() {
  for (auto& [name, points] : estimates_) {
    const EstimatePoint last = points.back();  // may be that of the report
    for (std::size_t i = 0; 2 * i + 1 < points.size(); ++i) points[i] = points[2 * i + 1];
    points.resize(std::max<std::size_t>(points.size() / 2, 1));
    points.back() = last;
  }
  look_every_ *= 2;
}

namespace {

/// Long enough to turn far, short enough that the gyro's drift does not show.
constexpr double kBlock_s = 20, kEnoughTurn_rad = 1, kLeastTurn_rad = 0.5, kLongestBlock_s = 60;
constexpr std::size_t kLeastSamples = 8;

/// Samples that follow each other without a gap.
class Block {
 public:
  explicit Block(const calib::Correction& estimates) : estimates_(estimates) {}

  void add(const TurnedSample& sample, double turn_rad) {
    const auto& reading = sample.reading;
    const double heading_rad = *reading.heading_rad;
    const double after_rad = calib::best_heading(estimates_, reading).value_or(heading_rad);
    if (residuals_.empty()) {
      first_before_rad_ = heading_rad - turn_rad;
      first_after_rad_ = after_rad - turn_rad;
      begin_s_ = reading.time_s;
      least_rad_ = most_rad_ = turn_rad;
    }
    least_rad_ = std::min(least_rad_, turn_rad);
    most_rad_ = std::max(most_rad_, turn_rad);
    end_s_ = reading.time_s;
    const double curve_rad =
        estimates_.compass ? base::wrapped(heading_rad - (*estimates_.compass)(heading_rad)) : 0;
    // From the first on, so that a residual near half a turn is no leap.
    residuals_.push_back({heading_rad, base::wrapped(heading_rad - turn_rad - first_before_rad_),
                          base::wrapped(after_rad - turn_rad - first_after_rad_), curve_rad});
  }

  [[nodiscard]] bool long_enough() const {
    const double took_s = end_s_ - begin_s_;
    return took_s > kLongestBlock_s || (took_s > kBlock_s && most_rad_ - least_rad_ > kEnoughTurn_rad);
  }

  void end(std::vector<HeadingResidual>& out) {
    if (residuals_.size() >= kLeastSamples && most_rad_ - least_rad_ >= kLeastTurn_rad) {
      const double before = mean(&HeadingResidual::before_rad), after = mean(&HeadingResidual::after_rad);
      const double curve = mean(&HeadingResidual::deviation_rad);
      for (HeadingResidual residual : residuals_) {
        residual.before_rad -= before;
        residual.after_rad -= after;
        residual.deviation_rad = residual.before_rad + curve;
        out.push_back(residual);
      }
    }
    residuals_.clear();
  }

 private:
  [[nodiscard]] double mean(double HeadingResidual::*which) const {
    double sum = 0;
    for (const auto& residual : residuals_) sum += residual.*which;
    return sum / static_cast<double>(residuals_.size());
  }

  const calib::Correction& estimates_;
  std::vector<HeadingResidual> residuals_;
  double first_before_rad_ = 0, first_after_rad_ = 0;
  double begin_s_ = 0, end_s_ = 0, least_rad_ = 0, most_rad_ = 0;
};

}  // namespace

std::vector<HeadingResidual> heading_residuals(const std::vector<TurnedSample>& samples,
                                               const calib::Correction& estimates) {
  std::vector<HeadingResidual> residuals;
  if (!estimates.gyro) return residuals;
  const bool needs_field = estimates.magnetometer.has_value();
  Block block(estimates);
  double turn_rad = 0;
  for (const TurnedSample& sample : samples) {
    if (!sample.has_turn || block.long_enough()) block.end(residuals);
    turn_rad = sample.has_turn ? turn_rad + estimates.gyro->scale * sample.measured_rad +
                                     estimates.gyro->bias_rad_s * sample.bias_time_s + sample.tilt_rad
                               : 0;
    if (sample.reading.heading_rad && (!needs_field || sample.reading.field_body_uT)) block.add(sample, turn_rad);
  }
  block.end(residuals);
  return residuals;
}

double root_mean_square(const std::vector<HeadingResidual>& residuals, double HeadingResidual::*which) {
  double sum = 0;
  for (const auto& residual : residuals) sum += residual.*which * (residual.*which);
  return residuals.empty() ? 0 : std::sqrt(sum / static_cast<double>(residuals.size()));
}

}  // namespace navcal::analysis
