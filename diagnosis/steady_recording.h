// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/nominal_balances.h"
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

  /// Several of them as one long recording, compared with these balances: of one session, whose departures do not
  /// average out, as far as they are alike. They depart from their mean in 6 (count - 1) numbers, which have the
  /// mean square q in the scatter of nominal recordings; the scatter of their mean has the part 1 - q + q / count.
  SteadyRecording(std::span<const RecordingModel* const> parts, const NominalBalances& nominal);

  /// From here on balances are compared with these. `scattered`: part of the scatter between recordings.
  void compare_with(const NominalBalances& nominal, double scattered = 1);
  /// Mean balance of the layout, N and Nm.
  [[nodiscard]] sim::Vector6 balance() const { return mean_balance(layout_); }
  /// Scatter of the balance by usual tolerances of the causes.
  [[nodiscard]] Eigen::MatrixXd usual_scatter() const;
  [[nodiscard]] const Eigen::MatrixXd& own_covariance() const { return own_covariance_; }

  [[nodiscard]] Eigen::VectorXd within(const Eigen::VectorXd& at) const override {
    return values_at(at) - values_at(Eigen::VectorXd::Zero(at.size()));
  }
  [[nodiscard]] std::optional<RecordingFit> fit(const Eigen::VectorXd& at) const override;
  /// Of the mean balance, in its standard errors; a block is the share of a stretch in it. No channel has
  /// readings: `apart` has the axes.
  [[nodiscard]] std::optional<RecordingPower> power(const Eigen::VectorXd& at) const override;
  /// Those of the nominal vehicle: any balance can be had by departures within the tolerances.
  [[nodiscard]] Eigen::VectorXd own_departures(const JointPrior& prior, const Likelihood&) const override {
    return prior.mean;
  }
  [[nodiscard]] const identify::RecordedMotion& recording() const override { return recording_; }
  [[nodiscard]] std::vector<std::string> oddities() const override { return inputs_.front().oddities(layout_); }

 private:
  /// Measured motion at the points of one stretch, every 0.1 s.
  struct Stretch {
    double begin_s = 0;
    std::vector<sim::Body> points;
    std::size_t inputs = 0;
  };
  using Balances = Eigen::Matrix<double, 6, Eigen::Dynamic>;  ///< one column for each stretch, N and Nm

  void find_stretches();
  [[nodiscard]] std::vector<MotionError> unmeasured() const;
  [[nodiscard]] Eigen::VectorXd values_at(const Eigen::VectorXd& at) const;
  /// The effect thrust_scale leaves the torque as it is. What weakens a thruster takes its torque as well, so here
  /// it scales both.
  [[nodiscard]] config::Layout layout_with(const Eigen::VectorXd& values) const;
  [[nodiscard]] Balances balances(const config::Layout& layout, const MotionError& error = {}) const;
  [[nodiscard]] sim::Vector6 mean_balance(const config::Layout& layout, const MotionError& error = {}) const {
    return balances(layout, error).rowwise().mean();
  }
  /// Change of the mean balance with one parameter.
  [[nodiscard]] sim::Vector6 slope(const Eigen::VectorXd& at, const sim::Vector6& here, Eigen::Index column) const;
  void leave_out(const std::vector<bool>& of_stretches);
  void leave_out_idle();
  void leave_out_apart();

  config::Layout layout_;
  const CauseLibrary& library_;
  const identify::RecordedMotion& recording_;
  std::vector<identify::ActuatorInputs> inputs_;  ///< of each recording
  std::vector<Stretch> stretches_;
  Eigen::MatrixXd own_covariance_;  ///< of the mean balance in this recording
  sim::Vector6 nominal_ = sim::Vector6::Zero();
  Eigen::LLT<Eigen::MatrixXd> covariance_;  ///< of the mean balance between recordings
  double freedom_ = std::numeric_limits<double>::infinity();
};

}  // namespace navcal::diagnosis
