// SPDX-License-Identifier: Apache-2.0
#include "identify/filter/filtered_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "identify/replay/motion_point.h"

namespace navcal::identify {
namespace {

constexpr double kLongestStep_s = 0.1, kTogether_s = 0.001;
constexpr double kSilence_s = 10;  ///< of all instruments, behind which the filter starts anew
constexpr double kLeftOut_s = 5;   ///< before a place where it diverges
constexpr double kEvidence_s = 1;  ///< at least, of readings behind that

/// Random walks that the disturbance does not contain, per root of a second: waves and the water's own motion in
/// the position, and rounding of the attitude.
constexpr double kDrift_m = 0.01, kSink_m = 0.003, kTurn_rad = 1e-4;

/// Errors of a start. The velocity is not measured everywhere.
FilterState first_stds() {
  FilterState all;
  all << 30, 30, 5, 0.3, 0.3, 0.5, 1, 1, 1, 0.5, 0.5, 0.5, 0.3, 0.3, sim::Vector6::Zero();
  return all;
}

/// Errors of the instruments by values, which begin with those of the parameters.
InstrumentErrors errors_of(std::span<const Parameter> parameters, const Eigen::VectorXd& values) {
  std::map<std::string_view, std::vector<double>> by_effect;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& number = parameters[i].of_instruments;
    const double value = values[static_cast<Eigen::Index>(i)];
    if (!number || value == 0) continue;
    std::vector<double>& all = by_effect[number->effect];
    all.resize(std::max(all.size(), number->parameter + 1));
    all[number->parameter] = value;
  }
  return InstrumentErrors(by_effect);
}

FilterState growth_of(const FilterNoises& noises, double step_s) {
  FilterState all = FilterState::Zero();
  all.head<6>() << kDrift_m * kDrift_m, kDrift_m * kDrift_m, kSink_m * kSink_m,
      Eigen::Vector3d::Constant(kTurn_rad * kTurn_rad);
  all.segment<6>(6) = noises.white.cwiseAbs2();
  all.head<12>() *= step_s;
  all.tail<6>() = -std::expm1(-2 * step_s / noises.tau_s) * noises.coloured.cwiseAbs2();
  return all;
}

FilterState stds_of(const FilterMatrix& covariance) { return covariance.diagonal().cwiseMax(0).cwiseSqrt(); }

/// Covariance a step later.
FilterMatrix grown(const FilterMatrix& covariance, const Transition& transition, const FilterState& growth) {
  FilterMatrix all = transition.on_both_sides_of(covariance);
  all.diagonal() += growth;
  return all;
}

/// Sequential updates of one step. `correction` is that of the state by the readings so far.
void update(std::span<FilterPass::Reading> readings, std::span<const double> variances, bool is_settling,
            FilterMatrix& covariance, FilterState& correction) {
  correction.setZero();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    FilterPass::Reading& reading = readings[i];
    FilterState across = FilterState::Zero();
    for (Eigen::Index s = 0; s < kFilterStates; ++s) {  // most readings depend on few states
      if (reading.sensitivity[s] != 0) across += reading.sensitivity[s] * covariance.col(s);
    }
    reading.variance = reading.sensitivity.dot(across) + variances[i];
    reading.gain = across / reading.variance;
    const double innovation = reading.innovation - reading.sensitivity.dot(correction);
    reading.white = innovation / std::sqrt(reading.variance);
    reading.is_settling = is_settling;
    if (is_settling) {
      reading.variance = 1;
      reading.white = 0;
    }
    correction += reading.gain * innovation;
    covariance.noalias() -= across * reading.gain.transpose();
  }
}

}  // namespace

Eigen::VectorXd FilterPass::white() const {
  Eigen::VectorXd all(std::ssize(readings));
  for (Eigen::Index i = 0; i < all.size(); ++i) all[i] = readings[static_cast<std::size_t>(i)].white;
  return all;
}

double FilterPass::power() const { return white().squaredNorm(); }

double FilterPass::log_det() const {
  double sum = 0;
  for (const Reading& reading : readings) sum += std::log(reading.variance);
  return sum;
}

double FilterPass::count() const {
  return static_cast<double>(
      std::count_if(readings.begin(), readings.end(), [](const auto& one) { return !one.is_settling; }));
}

double FilterPass::mean_square() const { return power() / std::max(count(), 1.0); }

FilteredReplay::FilteredReplay(config::Layout layout, std::vector<Parameter> parameters,
                               const RecordedMotion& recorded, const FilterNoises& noises, unsigned threads)
    : layout_(std::move(layout)), parameters_(std::move(parameters)), recorded_(recorded), noises_(noises),
      threads_(threads), inputs_(layout_, recorded) {
  if (!inputs_.missing().empty()) throw std::invalid_argument(recorded.name + ": " + inputs_.missing().front());
  if (!recorded.has(Channel::rate_x) && !recorded.has(Channel::rate_z) && !recorded.has(Channel::roll) &&
      !recorded.has(Channel::heading) && !recorded.has(Channel::bottom_x) && !recorded.has(Channel::water_x))
    throw std::invalid_argument(recorded.name +
                                ": no rates, no attitude and no Doppler log: nothing measures the motion");
  for (std::size_t c = 0; c < kChannels; ++c) {
    for (const Reading& reading : recorded.channels[c]) {
      if (reading.std > 0)
        readings_.push_back({static_cast<Channel>(c), reading.time_s, reading.value, reading.std});
    }
  }
  std::stable_sort(readings_.begin(), readings_.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  const double begin_s = readings_.front().time_s + kRunIn_s;
  std::erase_if(readings_, [&](const auto& reading) { return reading.time_s < begin_s; });
  make_steps();
  if (readings_.empty() || readings_.back().time_s - begin_s < kSettling_s + kEvidence_s)
    throw std::invalid_argument(fmt::format("{}: {:.1f} s with readings; at least {:.0f} s are needed",
                                            recorded.name, recorded.duration_s, kUnjudged_s + kEvidence_s));
  find_shown();
}

void FilteredReplay::find_shown() {
  // At a point where everything is at work.
  std::vector<ChannelReading> one_each;
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (!recorded_.channels[c].empty()) one_each.push_back({static_cast<Channel>(c), 1, 0, 1});
  }
  MotionPoint point = point_of(StateVector::LinSpaced(0.1, 0.3));
  point.acceleration.setConstant(0.2);
  const auto predicted = [&](const Eigen::VectorXd& values) {
    const Calibration with = values.tail<kNuisances>();
    Eigen::VectorXd all(std::ssize(one_each));
    PredictedReadings(recorded_, errors_of(parameters_, values))
        .at(point, current_of(with), one_each, with, all.data());
    return all;
  };
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(std::ssize(parameters_) + kNuisances);
  const Eigen::VectorXd perfect = predicted(none);
  shown_in_.assign(static_cast<std::size_t>(none.size()), {});
  for (std::size_t i = 0; i < shown_in_.size(); ++i) {
    const bool is_nuisance = i >= parameters_.size();
    if (!is_nuisance && !parameters_[i].of_instruments) continue;
    Eigen::VectorXd values = none;
    values[static_cast<Eigen::Index>(i)] = is_nuisance ? 0.01 : parameters_[i].prior_std;
    const Eigen::VectorXd moved = predicted(values) - perfect;
    for (std::size_t r = 0; r < one_each.size(); ++r) {
      const Channel channel = one_each[r].channel;
      const bool is_age = is_nuisance && delay_of(channel) == static_cast<Nuisance>(i - parameters_.size());
      shown_in_[i][static_cast<std::size_t>(channel)] = moved[static_cast<Eigen::Index>(r)] != 0 || is_age;
    }
  }
}

void FilteredReplay::make_steps() {
  steps_.clear();
  double now_s = -std::numeric_limits<double>::infinity(), started_s = now_s;
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    const double time_s = readings_[i].time_s;
    if (!steps_.empty() && time_s - steps_.back().time_s < kTogether_s) {
      ++steps_.back().count;
      continue;
    }
    const auto is_between = [&](double broken_s) { return broken_s >= now_s && broken_s < time_s; };
    if (time_s - now_s > kSilence_s || std::any_of(broken_s_.begin(), broken_s_.end(), is_between)) {
      steps_.push_back({time_s, 0, true, true, i, 1});
      started_s = time_s;
    } else {
      const double pieces = std::ceil((time_s - now_s) / kLongestStep_s), length_s = (time_s - now_s) / pieces;
      for (double k = 1; k < pieces; ++k) steps_.push_back({now_s + k * length_s, length_s, false, false, i, 0});
      steps_.push_back({time_s, length_s, false, time_s - started_s < kSettling_s, i, 1});
    }
    now_s = time_s;
  }
}

std::size_t FilteredReplay::stretches() const {
  return static_cast<std::size_t>(
      std::count_if(steps_.begin(), steps_.end(), [](const Step& step) { return step.starts_anew; }));
}

Eigen::VectorXd FilteredReplay::start() const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(std::ssize(parameters_) + kNuisances);
  values.head(std::ssize(parameters_)) = prior_values(parameters_);
  if (recorded_.declination_is_stated && !recorded_.heading_is_true)
    values[std::ssize(parameters_) + static_cast<Eigen::Index>(Nuisance::heading_offset)] =
        -*recorded_.declination_rad;
  return values;
}

std::size_t FilteredReplay::leave_out_diverging(const Eigen::VectorXd& values) {
  constexpr std::size_t kMost = 1000;
  const std::size_t all = readings_.size();
  std::size_t count = 0;
  for (;;) {
    FilterPass pass;
    const std::vector<double> places_s = run(values, pass, kMost);
    if (places_s.empty()) return count;
    count += places_s.size();
    for (const double place_s : places_s)
      std::erase_if(readings_, [&](const auto& reading) {
        return reading.time_s > place_s - kLeftOut_s && reading.time_s <= place_s;
      });
    broken_s_.insert(broken_s_.end(), places_s.begin(), places_s.end());
    make_steps();
    if (2 * readings_.size() < all)
      throw std::invalid_argument(fmt::format(
          "{}: the vehicle of the layout leaves all bounds (pitch beyond 88 degrees, 50 m/s) within a few seconds "
          "of most measured states, first at {:.1f} s; navcal vehicle check shows what is odd about it",
          recorded_.name, places_s.front()));
  }
}

FilteredReplay::Driven FilteredReplay::driven_by(const Eigen::VectorXd& values) const {
  const config::Layout layout = with_values(layout_, parameters_, values.head(std::ssize(parameters_)));
  return {sim::LayoutVehicle(layout), std::make_shared<const ActuatorTrajectory>(inputs_.trajectory(layout))};
}

FilterModel FilteredReplay::model_of(const Driven& driven, const Eigen::VectorXd& values) const {
  return {driven.vehicle, driven.actuators, recorded_, values.tail<kNuisances>(), errors_of(parameters_, values)};
}

FilterState FilteredReplay::measured(double time_s) const {
  StateVector state = StateVector::Zero();
  measure_state(recorded_, time_s, state);
  FilterState all = FilterState::Zero();
  all.head<kStates>() = state;
  return all;
}

FilterMatrix FilteredReplay::first_covariance(const FilterNoises& noises) const {
  FilterState variance = first_stds().cwiseAbs2();
  variance.tail<6>() = noises.coloured.cwiseAbs2();
  return variance.asDiagonal();
}

double FilteredReplay::variance_of(const ChannelReading& reading, const FilterNoises& noises) const {
  const double std = noises.factor[static_cast<std::size_t>(reading.channel)] * reading.std;
  return std * std;
}

std::vector<double> FilteredReplay::run(const Eigen::VectorXd& values, FilterPass& pass, std::size_t most) const {
  const Driven driven = driven_by(values);
  const FilterModel model = model_of(driven, values);
  pass.values = values;
  pass.tau_s = noises_.tau_s;
  pass.steps.resize(steps_.size());
  pass.readings.resize(readings_.size());
  std::vector<double> diverged_s, numbers;
  std::vector<FilterState> sensitivities;
  FilterState state;
  FilterMatrix covariance;
  bool starts_anew = false;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    pass.steps[k].time_s = step.time_s;
    if (step.starts_anew || starts_anew) {
      state = measured(step.time_s);
      pass.steps[k].begin = state;
      covariance = first_covariance(noises_);
      pass.steps[k].stds = stds_of(covariance);
      starts_anew = false;
    } else {
      pass.steps[k].begin = state;
      const auto moved = model.moved_over(step.time_s - step.length_s, step.length_s);
      const FilterState end = model.after(state, moved, step.length_s, noises_.tau_s);
      pass.steps[k].stds = stds_of(covariance);
      pass.steps[k].derivatives =
          model.derivatives(state, pass.steps[k].stds, end, moved, step.length_s, noises_.tau_s);
      const Transition transition(pass.steps[k].derivatives, recorded_.tilt_lag_s, step.length_s, noises_.tau_s);
      covariance = grown(covariance, transition, growth_of(noises_, step.length_s));
      state = end;
    }
    const auto readings = readings_of(step);
    const std::span<FilterPass::Reading> out(pass.readings.data() + step.first, step.count);
    numbers.resize(step.count);
    sensitivities.resize(step.count);
    if (step.count > 0 && is_sane(point_of(state.head<kStates>()).body)) {
      model.innovations(state, step.time_s, readings, numbers.data());
      model.sensitivities(state, stds_of(covariance), step.time_s, readings, sensitivities);
      for (std::size_t i = 0; i < step.count; ++i) {
        out[i].innovation = numbers[i];
        out[i].sensitivity = sensitivities[i];
        numbers[i] = variance_of(readings[i], noises_);
      }
      update(out, numbers, step.is_settling, covariance, pass.steps[k].correction);
      state += pass.steps[k].correction;
    } else {
      pass.steps[k].correction.setZero();
    }
    if (is_sane(point_of(state.head<kStates>()).body)) continue;
    diverged_s.push_back(step.time_s);
    if (diverged_s.size() >= most) break;
    starts_anew = true;
  }
  return diverged_s;
}

std::optional<FilterPass> FilteredReplay::follow(const Eigen::VectorXd& values) const {
  FilterPass pass;
  if (!run(values, pass, 1).empty()) return std::nullopt;
  return pass;
}

Eigen::VectorXd FilteredReplay::replayed(const FilterPass& pass, const Eigen::VectorXd& values) const {
  const Driven driven = driven_by(values);
  return replayed(pass, model_of(driven, values)).white;
}

FilteredReplay::Course FilteredReplay::replayed(const FilterPass& pass, const FilterModel& model) const {
  Course course{Eigen::VectorXd(std::ssize(readings_)), {}, {}, std::vector<double>(readings_.size())};
  FilterState state = FilterState::Zero();
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    course.begins.push_back(state);
    state = step.starts_anew ? measured(step.time_s)
                             : model.after(state, model.moved_over(step.time_s - step.length_s, step.length_s),
                                           step.length_s, noises_.tau_s);
    course.ends.push_back(state);
    if (!is_sane(point_of(state.head<kStates>()).body)) return {};
    if (step.count == 0) continue;
    model.innovations(state, step.time_s, readings_of(step), course.innovations.data() + step.first);
    FilterState correction = FilterState::Zero();
    for (std::size_t i = step.first; i < step.first + step.count; ++i) {
      const FilterPass::Reading& held = pass.readings[i];
      const double innovation = course.innovations[i] - held.sensitivity.dot(correction);
      course.white[static_cast<Eigen::Index>(i)] = held.is_settling ? 0 : innovation / std::sqrt(held.variance);
      correction += held.gain * innovation;
    }
    state += correction;
  }
  return course;
}

sim::Vector6 FilteredReplay::actuator_power(const FilterPass& pass) const {
  constexpr std::size_t kEvery = 5;
  const Driven driven = driven_by(pass.values);
  const FilterModel model = model_of(driven, pass.values);
  const auto neutral = driven.vehicle.hold(sim::ActuatorValues::neutral(layout_));
  sim::Vector6 sum = sim::Vector6::Zero();
  double count = 0;
  for (std::size_t k = 0; k < steps_.size(); k += kEvery, ++count) {
    const sim::Body body = point_of(pass.steps[k].begin.head<kStates>()).body;
    const Eigen::Vector3d down = sim::down_of(body.euler_rad);
    const auto moved = model.moved_over(steps_[k].time_s - steps_[k].length_s, steps_[k].length_s);
    const auto& held = moved.middle;
    const sim::Vector6 force =
        driven.vehicle.force(body.velocity, down, held) - driven.vehicle.force(body.velocity, down, neutral);
    sum += (held.mass_inverse * force).cwiseAbs2();
  }
  return sum / std::max(count, 1.0);
}

FilteredReplay::Neighbours FilteredReplay::neighbours(std::span<const FilterPass::Reading> of,
                                                      std::size_t channel) const {
  Neighbours all;
  double before = 0;
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    if (static_cast<std::size_t>(readings_[i].channel) != channel) continue;
    const double white = of[i].white;
    all.products += before * white;
    all.squares += white * white;
    before = white;
    ++all.count;
  }
  return all;
}

void FilteredReplay::filter_again(const FilterPass& pass, const FilterNoises& noises,
                                  std::span<FilterPass::Reading> out) const {
  FilterState apart = FilterState::Zero();  // of the states of the two filters
  FilterMatrix covariance;
  FilterState correction;
  std::vector<double> variances;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    if (step.starts_anew) {
      apart.setZero();
      covariance = first_covariance(noises);
    } else {
      const Transition transition(pass.steps[k].derivatives, recorded_.tilt_lag_s, step.length_s, noises.tau_s);
      apart = transition * apart;
      apart.tail<6>() += (std::exp(-step.length_s / noises.tau_s) - std::exp(-step.length_s / pass.tau_s)) *
                         pass.steps[k].begin.tail<6>();
      covariance = grown(covariance, transition, growth_of(noises, step.length_s));
    }
    if (step.count == 0) continue;
    const auto here = out.subspan(step.first, step.count);
    variances.resize(step.count);
    for (std::size_t i = 0; i < step.count; ++i) {
      const FilterPass::Reading& then = pass.readings[step.first + i];
      here[i].sensitivity = then.sensitivity;
      here[i].innovation = then.innovation - then.sensitivity.dot(apart);
      variances[i] = variance_of(readings_[step.first + i], noises);
    }
    update(here, variances, step.is_settling, covariance, correction);
    apart += correction - pass.steps[k].correction;
  }
}

}  // namespace navcal::identify
