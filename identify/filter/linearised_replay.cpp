// SPDX-License-Identifier: Apache-2.0
// FilteredReplay::linearise().
#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/parallel.h"
#include "identify/filter/filtered_replay.h"
#include "identify/replay/motion_point.h"

namespace navcal::identify {
namespace {

constexpr double kColumnPart = 1e-3;  ///< of a prior's standard deviation
constexpr double kDelayColumn_s = 0.005;

}  // namespace

std::vector<FilterModel::Acceleration> FilteredReplay::accelerations(const Course& course,
                                                                     const FilterModel& model) const {
  std::vector<FilterModel::Acceleration> all(steps_.size());
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    if (step.starts_anew) continue;
    // The readings in between move the state too little to change forces.
    const bool goes_on = k > 0 && !steps_[k - 1].starts_anew;
    all[k] = model.acceleration_over(course.begins[k], course.ends[k], step.time_s - step.length_s, step.length_s,
                                     goes_on ? &all[k - 1].end : nullptr);
  }
  return all;
}

Eigen::VectorXd FilteredReplay::slope(const About& about, const FilterModel& moved, const Channels& shown_in,
                                      double by) const {
  const Course& course = about.course;
  const Eigen::Vector3d carried = (moved.current() - about.model.current()) / by;
  const auto by_moved =
      moved.is_driven_as(about.model) ? std::vector<FilterModel::Acceleration>{} : accelerations(course, moved);
  const bool has_same_forces = by_moved.empty() && moved.is_prompt() && about.model.is_prompt();
  const bool feels_as_before = moved.feels_tilt_as(about.model);
  Eigen::VectorXd white = Eigen::VectorXd::Zero(course.white.size());
  // Another clock of the step's end may be on the other side of a command: each is compared with its like.
  const std::vector<double>& nominal = has_same_forces ? about.by_accelerations : course.innovations;
  std::vector<double> innovations = nominal, numbers;
  std::vector<ChannelReading> shown;
  FilterState apart = FilterState::Zero();  // of the two vehicles, over `by`
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    if (step.starts_anew) {
      apart.setZero();
    } else {
      const Transition& transition = about.transitions[k];
      apart = transition * apart;
      if (!by_moved.empty()) {
        // The integral of exp(A t) by its end F: (F + 1)/2 - (F - 1)^2/12. What falls over the step moves further.
        FilterState kick = FilterState::Zero(), sooner = kick;
        kick.segment<6>(6) = step.length_s / by * (by_moved[k].mean - about.accelerations[k].mean);
        sooner.segment<6>(6) = step.length_s / by * (by_moved[k].fall - about.accelerations[k].fall);
        const FilterState grown = transition * kick - kick;
        const FilterState less = grown - sooner;
        apart += kick + grown / 2 - (transition * less - less) / 12;
      }
      apart.head<3>() += step.length_s * carried;
      if (!feels_as_before)
        apart.segment<2>(kTilt) += moved.tilt_beyond(about.model, course.begins[k], course.ends[k],
                                                     about.accelerations[k], step.length_s) /
                                   by;
    }
    const auto readings = readings_of(step);
    const auto is_shown = [&](const ChannelReading& reading) {
      return shown_in[static_cast<std::size_t>(reading.channel)];
    };
    if (has_same_forces && !step.starts_anew) {
      shown.clear();
      std::ranges::copy_if(readings, std::back_inserter(shown), is_shown);
      numbers.resize(shown.size());
      if (!shown.empty())
        moved.innovations(course.ends[k], step.time_s, shown, numbers.data(), &about.accelerations[k].end);
      for (std::size_t i = 0, next = 0; i < readings.size(); ++i)
        if (is_shown(readings[i])) innovations[step.first + i] = numbers[next++];
    } else if (std::ranges::any_of(readings, is_shown)) {
      moved.innovations(course.ends[k], step.time_s, readings, innovations.data() + step.first);
    }
    FilterState correction = FilterState::Zero();
    for (std::size_t i = step.first; i < step.first + step.count; ++i) {
      const FilterPass::Reading& held = about.pass.readings[i];
      const double innovation = (innovations[i] - nominal[i]) / by - about.sensitivities[i].dot(apart) -
                                held.sensitivity.dot(correction);
      if (!held.is_settling) white[static_cast<Eigen::Index>(i)] = innovation / std::sqrt(held.variance);
      correction += held.gain * innovation;
    }
    apart += correction;
  }
  return white;
}

std::vector<StepDerivatives> FilteredReplay::take_derivatives(About& about) const {
  std::vector<StepDerivatives> derivatives(steps_.size());
  base::in_parallel(threads_, steps_.size(), [&](std::size_t k) {
    const Step& step = steps_[k];
    const FilterState &stds = about.pass.steps[k].stds, &end = about.course.ends[k];
    if (!step.starts_anew) {
      const auto moved = about.model.moved_over(step.time_s - step.length_s, step.length_s);
      derivatives[k] =
          about.model.derivatives(about.course.begins[k], stds, end, moved, step.length_s, noises_.tau_s);
    }
    about.model.sensitivities(end, stds, step.time_s, readings_of(step),
                              std::span(about.sensitivities).subspan(step.first, step.count));
  });
  return derivatives;
}

std::optional<FilterLinearised> FilteredReplay::linearise(const FilterPass& pass, const Eigen::VectorXd& at_values,
                                                          std::span<const Eigen::Index> columns) const {
  const Driven nominal = driven_by(at_values);
  const FilterModel model = model_of(nominal, at_values);
  About about{pass, model, replayed(pass, model), {}, {}, {}, {}};
  if (about.course.white.size() == 0) return std::nullopt;
  FilterLinearised out{{}, about.course.white, about.course.white.squaredNorm(), pass.log_det()};
  if (columns.empty()) return out;
  about.accelerations = accelerations(about.course, model);
  about.by_accelerations = about.course.innovations;
  for (std::size_t k = 0; k < steps_.size() && model.is_prompt(); ++k) {
    if (const Step& step = steps_[k]; !step.starts_anew)
      model.innovations(about.course.ends[k], step.time_s, readings_of(step),
                        about.by_accelerations.data() + step.first, &about.accelerations[k].end);
  }
  for (const FilterPass::Reading& reading : pass.readings) about.sensitivities.push_back(reading.sensitivity);
  std::vector<StepDerivatives> own;
  if (at_values != pass.values) own = take_derivatives(about);
  for (std::size_t k = 0; k < steps_.size(); ++k)
    about.transitions.emplace_back(own.empty() ? pass.steps[k].derivatives : own[k], recorded_.tilt_lag_s,
                                   steps_[k].length_s, noises_.tau_s);
  out.jacobian = Eigen::MatrixXd::Zero(out.count(), std::ssize(columns));
  const auto parameters = std::ssize(parameters_);
  const Calibration stds = nuisance_stds(recorded_);
  // An accelerometer feels forces at once, and what is late is asked of the motion before.
  Channels felt;
  for (std::size_t i = 0; i < kChannels; ++i) felt[i] = model.feels_forces(static_cast<Channel>(i));
  base::in_parallel(threads_, columns.size(), [&](std::size_t c) {
    const Eigen::Index at = columns[c];
    auto column = out.jacobian.col(static_cast<Eigen::Index>(c));
    const auto stepped = [&](double step) {
      Eigen::VectorXd values = at_values;
      values[at] += step;
      return values;
    };
    if (at >= parameters) {
      const auto nuisance = static_cast<Nuisance>(at - parameters);
      if (!matters(nuisance)) return;
      const double step = is_delay(nuisance) ? kDelayColumn_s : kColumnPart * stds[at - parameters];
      column = slope(about, model_of(nominal, stepped(step)),
                     nuisance == Nuisance::actuator_delay ? felt : shown_in(nuisance), step);
      return;
    }
    const Parameter& parameter = parameters_[static_cast<std::size_t>(at)];
    if (parameter.of_instruments) {
      const double step = kColumnPart * parameter.prior_std;
      column = slope(about, model_of(nominal, stepped(step)), shown_in_[static_cast<std::size_t>(at)], step);
      return;
    }
    const auto slope_over = [&](double step) {
      const Eigen::VectorXd values = stepped(step);
      const config::Layout layout = with_values(layout_, parameters_, values.head(parameters));
      const Driven moved{sim::LayoutVehicle(layout),
                         moves_actuators(parameter)
                             ? std::make_shared<const ActuatorTrajectory>(inputs_.trajectory(layout))
                             : nominal.actuators};
      return slope(about, model_of(moved, values), felt, step);
    };
    const double step = parameter.step > 0 ? parameter.step : kColumnPart * parameter.prior_std;
    // An effect that cannot be negative is not linear about zero; away from zero it is, but for a dead band in
    // whose end no command lies.
    if (parameter.change && parameter.low == 0 && at_values[at] > step / 4) {
      column = slope_over(-at_values[at] / 4);
      if (column.isZero(0)) column = slope_over(-at_values[at]);
    } else {
      column = slope_over(at_values[at] + step > parameter.high ? -step : step);
    }
  });
  return out;
}

}  // namespace navcal::identify
