// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <bitset>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/layout.h"
#include "identify/data/recorded_motion.h"
#include "identify/filter/filter_model.h"
#include "identify/parameters.h"

namespace navcal::identify {

/// An extended Kalman filter that followed a recording once: gains and derivatives at every step, and the
/// innovations. With these gains held, other values are replayed without any covariance.
struct FilterPass {
  struct Step {
    double time_s = 0;            ///< its end, where its readings are
    FilterState begin;            ///< the state before it; as measured where the filter starts anew
    FilterState stds;             ///< its standard errors, over which derivatives are taken
    StepDerivatives derivatives;  ///< of its end; of no meaning where the filter starts anew
    FilterState correction;       ///< of its end, by all its readings
  };
  struct Reading {
    FilterState sensitivity, gain;  ///< H and K of a sequential scalar update
    double innovation;              ///< of the state before the step's first update, SI
    double variance;                ///< S, with the updates before it; 1 while the filter settles
    double white;                   ///< innovation with the updates before it, over the root of S; then 0
    bool is_settling = false;       ///< right behind a start: corrects the state, but is no evidence
  };
  Eigen::VectorXd values;
  double tau_s = 0;  ///< of the disturbance
  std::vector<Step> steps;
  std::vector<Reading> readings;

  [[nodiscard]] Eigen::VectorXd white() const;
  [[nodiscard]] double power() const;    ///< sum of squares of the white innovations
  [[nodiscard]] double log_det() const;  ///< sum of ln S
  [[nodiscard]] double count() const;    ///< of readings that are evidence
  /// 1 where vehicle, noises and recording agree.
  [[nodiscard]] double mean_square() const;
  /// Twice the negative log likelihood but for a constant.
  [[nodiscard]] double cost() const { return power() + log_det(); }
};

/// White innovations r at some values and their derivatives J by some of them, the gains held:
///   log p(values + dx) = const + score . dx - dx . information dx / 2,  score = -J^T r, information = J^T J,
///   const = -(power + log_det)/2.
struct FilterLinearised {
  Eigen::MatrixXd jacobian;  ///< one row for each reading in the order of FilteredReplay::readings()
  Eigen::VectorXd white;
  double power = 0, log_det = 0;

  [[nodiscard]] Eigen::Index count() const { return white.size(); }
  [[nodiscard]] Eigen::VectorXd score() const { return -jacobian.transpose() * white; }
  [[nodiscard]] Eigen::MatrixXd information() const { return jacobian.transpose() * jacobian; }
};

/// A recording followed by a filter over the dynamics of a layout, for identification and diagnosis.
///
/// The filter steps from reading to reading, at most 0.1 s at once; readings closer than 1 ms are taken together.
/// Unknown are `values`: the parameters in their units, then the nuisances (Nuisance) of the recording. Where the
/// recording is silent for 10 s it starts anew at the measured state, with wide errors; the same behind a stretch
/// that diverges. Readings of its first three seconds are no evidence: the filter is linear about a state that
/// it does not know yet.
class FilteredReplay {
 public:
  /// Begin of a recording that is no evidence, s: what the actuators did before it is not known, and then the
  /// filter settles. Pitch of simulated vehicles that begin under way, mean square of the innovations: 1.09 behind
  /// 1 and 2 s of settling.
  static constexpr double kRunIn_s = 1, kSettling_s = 3, kUnjudged_s = kRunIn_s + kSettling_s;

  /// `recorded` must outlive it. Throws std::invalid_argument in words when commands or readings are missing.
  FilteredReplay(config::Layout layout, std::vector<Parameter> parameters, const RecordedMotion& recorded,
                 const FilterNoises& noises, unsigned threads = 2);

  /// Parameters at their priors, nuisances zero but for a stated declination.
  [[nodiscard]] Eigen::VectorXd start() const;
  /// Leaves out five seconds before each place where the filter leaves all bounds with these values, until it
  /// passes; returns their number. Throws std::invalid_argument where less than half of the readings remain.
  std::size_t leave_out_diverging(const Eigen::VectorXd& values);

  /// Follows the recording and computes the gains. nullopt: the vehicle leaves all bounds.
  [[nodiscard]] std::optional<FilterPass> follow(const Eigen::VectorXd& values) const;
  /// White innovations of other values with the gains of a pass; empty where the vehicle leaves all bounds.
  [[nodiscard]] Eigen::VectorXd replayed(const FilterPass& pass, const Eigen::VectorXd& values) const;
  /// The same of a pass's own values, with the derivatives by some of them (`columns`: places among the values).
  /// Each step's change is that of its mean acceleration; the pass's own derivatives carry it on.
  [[nodiscard]] FilterLinearised linearise(const FilterPass& pass, std::span<const Eigen::Index> columns) const {
    return *linearise(pass, pass.values, columns);
  }
  /// Linearises other values with the gains of the pass. nullopt: the vehicle leaves all bounds with these values.
  [[nodiscard]] std::optional<FilterLinearised> linearise(const FilterPass& pass, const Eigen::VectorXd& values,
                                                          std::span<const Eigen::Index> columns) const;

  /// The innovations of a pass under other noises, its derivatives held: no call of the model. `out` has the
  /// readings' variances and white innovations; its other members stay as they are.
  void filter_again(const FilterPass& pass, const FilterNoises& noises, std::span<FilterPass::Reading> out) const;

  /// White innovations of one channel: their number, squares, and products of neighbours. `of`: a pass's readings.
  struct Neighbours {
    double count = 0, squares = 0, products = 0;

    [[nodiscard]] double correlation() const { return squares > 0 ? products / squares : 0; }
  };
  [[nodiscard]] Neighbours neighbours(std::span<const FilterPass::Reading> of, std::size_t channel) const;

  void set_noises(const FilterNoises& noises) { noises_ = noises; }
  [[nodiscard]] const FilterNoises& noises() const { return noises_; }
  /// In the order of time, without those left out.
  [[nodiscard]] const std::vector<ChannelReading>& readings() const { return readings_; }
  [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }
  [[nodiscard]] const config::Layout& layout() const { return layout_; }
  [[nodiscard]] const RecordedMotion& recording() const { return recorded_; }
  /// Whether the readings of the recording depend on a nuisance at all.
  [[nodiscard]] bool matters(Nuisance nuisance) const {
    return nuisance == Nuisance::actuator_delay || shown_in(nuisance).any();
  }
  [[nodiscard]] std::size_t stretches() const;  ///< starts of the filter
  [[nodiscard]] std::vector<std::string> oddities() const { return inputs_.oddities(layout_); }
  /// Whether an actuator follows commands, which may reach it late; else all report where they are.
  [[nodiscard]] bool follows_commands() const { return inputs_.follow_commands(); }
  /// Mean square of the accelerations that the actuators cause in a pass, axis by axis, m/s2 and rad/s2.
  [[nodiscard]] sim::Vector6 actuator_power(const FilterPass& pass) const;

 private:
  struct Step {
    double time_s, length_s;
    bool starts_anew, is_settling;
    std::size_t first, count;  ///< of its readings
  };
  /// A vehicle with where its actuators were.
  struct Driven {
    sim::LayoutVehicle vehicle;
    std::shared_ptr<const ActuatorTrajectory> actuators;
  };
  [[nodiscard]] Driven driven_by(const Eigen::VectorXd& values) const;
  [[nodiscard]] FilterModel model_of(const Driven& driven, const Eigen::VectorXd& values) const;
  /// Finds which channels each of the values shows in by itself.
  void find_shown();
  [[nodiscard]] FilterState measured(double time_s) const;
  [[nodiscard]] std::span<const ChannelReading> readings_of(const Step& step) const {
    return {readings_.data() + step.first, step.count};
  }
  [[nodiscard]] FilterMatrix first_covariance(const FilterNoises& noises) const;
  [[nodiscard]] double variance_of(const ChannelReading& reading, const FilterNoises& noises) const;
  void make_steps();
  /// Places where the filter left all bounds, the filter starting anew behind each; at most `most`.
  [[nodiscard]] std::vector<double> run(const Eigen::VectorXd& values, FilterPass& pass, std::size_t most) const;
  /// A replay: white innovations, and what its steps and readings were.
  struct Course {
    Eigen::VectorXd white;                  ///< empty: the vehicle left all bounds
    std::vector<FilterState> begins, ends;  ///< of the steps, before the readings at their ends
    std::vector<double> innovations;        ///< before the step's first update
  };
  [[nodiscard]] Course replayed(const FilterPass& pass, const FilterModel& model) const;
  /// nu' over each step of a course.
  [[nodiscard]] std::vector<FilterModel::Acceleration> accelerations(const Course& course,
                                                                     const FilterModel& model) const;
  using Channels = std::bitset<kChannels>;
  /// Channels of the recording whose readings depend on a nuisance in other ways than by the motion.
  [[nodiscard]] const Channels& shown_in(Nuisance nuisance) const {
    return shown_in_[parameters_.size() + static_cast<std::size_t>(nuisance)];
  }
  /// A course of a model, about which it is linearised, and what all columns share.
  struct About {
    const FilterPass& pass;
    const FilterModel& model;
    Course course;
    std::vector<FilterModel::Acceleration> accelerations;
    std::vector<double> by_accelerations;    ///< the innovations with those at the ends of the steps
    std::vector<Transition> transitions;     ///< of the steps; of no meaning where the filter starts anew
    std::vector<FilterState> sensitivities;  ///< of the readings' predictions
  };
  /// Derivatives of a course that is not that of the pass: held ones are those of other forces.
  [[nodiscard]] std::vector<StepDerivatives> take_derivatives(About& about) const;
  /// Derivative of the white innovations: what `moved` changes, which `shown_in` see at once, over `by`.
  [[nodiscard]] Eigen::VectorXd slope(const About& about, const FilterModel& moved, const Channels& shown_in,
                                      double by) const;

  config::Layout layout_;
  std::vector<Parameter> parameters_;
  const RecordedMotion& recorded_;
  FilterNoises noises_;
  unsigned threads_;
  ActuatorInputs inputs_;
  std::vector<ChannelReading> readings_;
  std::vector<Step> steps_;
  std::vector<double> broken_s_;    ///< ends of what was left out
  std::vector<Channels> shown_in_;  ///< of each of the values; numbers of the layout show in none by themselves
};

}  // namespace navcal::identify
