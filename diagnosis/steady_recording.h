// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/recording_fit.h"
#include "identify/data/actuator_inputs.h"
#include "sim/vehicle/body.h"

namespace navcal::diagnosis {

/// An error that all points of a measured motion have.
struct MotionError {
  Eigen::Vector3d euler_rad = Eigen::Vector3d::Zero();
  sim::Vector6 velocity = sim::Vector6::Zero();
};

/// A recording by the balance of its mean forces and moments over steady stretches: with a layout that is true,
///   r = mean of (tau(nu, down, actuators) - C nu) - M (nu_end - nu_begin) / T = 0.
/// Nothing is integrated, so it serves a vehicle that its controller holds and whose fault stands in the commands.
/// It tells nothing of lags, delays and instruments.
///
/// Stretches are 1 s long. Those in which the thrusters hardly work (on the ground, adrift) and those apart from
/// the others are left out. What is not measured (tilt, velocity through the water) is zero, with an error
/// that the balance inherits. The recording and the library must outlive it.
class SteadyRecording final : public RecordingModel {
 public:
  /// Throws std::invalid_argument in words when commands are missing or fewer than five stretches are left.
  SteadyRecording(const config::Layout& layout, const CauseLibrary& library,
                  const identify::RecordedMotion& recording);

  [[nodiscard]] std::optional<RecordingFit> fit(const Eigen::VectorXd& at) const override;
  /// Of the mean balance, in its standard errors; a block is the share of a stretch in it. No channel has
  /// readings.
  [[nodiscard]] std::optional<RecordingPower> power(const Eigen::VectorXd& at) const override;
  /// Those of the nominal vehicle: any balance can be had by departures within the tolerances.
  [[nodiscard]] Eigen::VectorXd own_departures(const JointPrior& prior, const Likelihood&) const override {
    return prior.mean;
  }
  [[nodiscard]] const identify::RecordedMotion& recording() const override { return recording_; }
  [[nodiscard]] std::vector<std::string> oddities() const override { return inputs_.oddities(layout_); }

 private:
  /// Measured motion at the points of one stretch, every 0.1 s.
  struct Stretch {
    double begin_s = 0;
    std::vector<sim::Body> points;
  };
  using Balances = Eigen::Matrix<double, 6, Eigen::Dynamic>;  ///< one column for each stretch, N and Nm

  void find_stretches();
  [[nodiscard]] std::vector<MotionError> unmeasured() const;
  [[nodiscard]] Eigen::VectorXd values_at(const Eigen::VectorXd& at) const;
  [[nodiscard]] config::Layout layout_with(const Eigen::VectorXd& values) const;
  [[nodiscard]] Balances balances(const config::Layout& layout, const MotionError& error = {}) const;
  [[nodiscard]] sim::Vector6 mean_balance(const config::Layout& layout, const MotionError& error = {}) const {
    return balances(layout, error).rowwise().mean();
  }
  void leave_out_idle();
  void leave_out_apart();

  config::Layout layout_;
  const CauseLibrary& library_;
  const identify::RecordedMotion& recording_;
  identify::ActuatorInputs inputs_;
  std::vector<Stretch> stretches_;
  Eigen::LLT<Eigen::MatrixXd> covariance_;  ///< of the mean balance
};

/// Effects of a layout that mean forces can tell: those of actuators and of the hull at rest. Of an actuator the
/// gain is one: the offset, the dead band and the gain of a steady command are not told apart.
[[nodiscard]] CauseLibrary steady_causes_of(const config::Layout& layout,
                                            const identify::RecordedMotion& recording,
                                            std::span<const std::string> excluded);

/// Recordings by their steady stretches. Layout and library must outlive it and its models.
class SteadySource final : public ModelSource {
 public:
  SteadySource(const config::Layout& layout, const CauseLibrary& library) : layout_(layout), library_(library) {}

  [[nodiscard]] std::unique_ptr<RecordingModel> nominal(const identify::RecordedMotion& recording) override {
    return std::make_unique<SteadyRecording>(layout_, library_, recording);
  }
  void refine(std::size_t, std::span<const Eigen::VectorXd>) override {}
  [[nodiscard]] std::unique_ptr<RecordingModel> compared(const identify::RecordedMotion& recording,
                                                         const Eigen::VectorXd&) const override {
    return std::make_unique<SteadyRecording>(layout_, library_, recording);
  }
  [[nodiscard]] Leads leads(std::size_t nominals) const override;

 private:
  const config::Layout& layout_;
  const CauseLibrary& library_;
};

}  // namespace navcal::diagnosis
