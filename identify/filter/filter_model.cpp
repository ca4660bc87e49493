// SPDX-License-Identifier: Apache-2.0
#include "identify/filter/filter_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angles.h"

namespace navcal::identify {
namespace {

/// Step of a difference, SI: the standard error of the state, for a slope where the vehicle may be. At rest drag
/// has none, and a filter that does not know the speed would take what it does to the accelerometers for a tilt.
/// (Statistical linearisation: Gelb 1974, Applied Optimal Estimation, section 6.2.)
double difference_for(double std) { return std::max(1e-5, std); }
constexpr Eigen::Index kEuler = 3, kVelocity = 6;

bool is_force(Channel channel) { return channel >= Channel::force_x && channel <= Channel::force_z; }

double difference_of(const ChannelReading& reading, double a, double b) {
  return describe(reading.channel).is_angle ? base::wrapped(a - b) : a - b;
}

/// The rows of F x but for the disturbance, for each column of x.
template <int columns>
Eigen::Matrix<double, kStates, columns> motion(const StepDerivatives& by, double half_step_s, double tilt_left,
                                               const Eigen::Matrix<double, kFilterStates, columns>& x) {
  Eigen::Matrix<double, kStates, columns> end;
  for (Eigen::Index j = 0; j < columns; ++j) {
    const sim::Vector6 kick = half_step_s * x.col(j).template tail<6>();
    const sim::Vector6 velocity = x.col(j).template segment<6>(kVelocity) + kick;
    // One expression, so that its sums stay in registers.
    end.col(j) = x(kEuler, j) * by.col(0) + x(kEuler + 1, j) * by.col(1) + x(kEuler + 2, j) * by.col(2) +
                 velocity[0] * by.col(3) + velocity[1] * by.col(4) + velocity[2] * by.col(5) +
                 velocity[3] * by.col(6) + velocity[4] * by.col(7) + velocity[5] * by.col(8);
    end.col(j).template head<3>() += x.col(j).template head<3>();
    end.col(j).template segment<6>(kVelocity) += kick;
    end.col(j).template segment<2>(kTilt) += tilt_left * x.col(j).template segment<2>(kTilt);
  }
  return end;
}

}  // namespace

FilterModel::FilterModel(const sim::LayoutVehicle& vehicle, std::shared_ptr<const ActuatorTrajectory> actuators,
                         const RecordedMotion& recorded, const Calibration& calibration, InstrumentErrors errors)
    : vehicle_(vehicle), actuators_(std::move(actuators)), calibration_(calibration), errors_(std::move(errors)),
      instruments_(recorded, errors_), tilt_lag_s_(recorded.tilt_lag_s) {}

std::array<sim::ActuatorValues, 3> FilterModel::actuators_over(double time_s, double step_s) const {
  const double from_s = time_s - get(calibration_, Nuisance::actuator_delay);
  sim::ActuatorValues begin = sim::ActuatorValues::neutral(vehicle_.layout()), end = begin, middle = begin;
  actuators_->at(from_s, begin);
  actuators_->at(from_s + step_s, end);
  actuators_->mean(from_s, step_s, middle);
  const auto solve = [](sim::ActuatorNumbers& mean, const sim::ActuatorNumbers& a, const sim::ActuatorNumbers& b) {
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (6 * mean[i] - a[i] - b[i]) / 4;
  };
  solve(middle.thrusters, begin.thrusters, end.thrusters);
  solve(middle.surfaces_rad, begin.surfaces_rad, end.surfaces_rad);
  solve(middle.ballasts_N, begin.ballasts_N, end.ballasts_N);
  solve(middle.masses_m, begin.masses_m, end.masses_m);
  return {begin, middle, end};
}

FilterModel::Moved FilterModel::moved_over(double time_s, double step_s) const {
  const auto [begin, middle, end] = actuators_over(time_s, step_s);
  return {vehicle_.hold(begin), vehicle_.hold(middle), vehicle_.hold(end)};
}

FilterModel::Acceleration FilterModel::acceleration_over(const FilterState& from, const FilterState& to,
                                                         double time_s, double step_s,
                                                         const sim::Vector6* begin) const {
  const auto actuators = actuators_over(time_s, step_s);
  const auto at = [&](const FilterState& state, const sim::ActuatorValues& by) {
    return vehicle_.acceleration(point_of(state.head<kStates>()).body, vehicle_.hold(by));
  };
  const sim::Vector6 first = begin != nullptr ? *begin : at(from, actuators[0]);
  const sim::Vector6 middle = at((from + to) / 2, actuators[1]), last = at(to, actuators[2]);
  return {(first + 4 * middle + last) / 6, first - last, last};
}

Eigen::Vector2d FilterModel::tilt_beyond(const FilterModel& other, const FilterState& from, const FilterState& to,
                                         const Acceleration& over, double step_s) const {
  const auto beyond = [&](const FilterState& state, const sim::Vector6& acceleration) {
    const sim::Body body = point_of(state.head<kStates>()).body;
    const sim::Vector6 disturbed = acceleration + state.tail<6>();
    return Eigen::Vector2d(errors_.felt_tilt(body, disturbed) - other.errors_.felt_tilt(body, disturbed));
  };
  return lagged_tilt(Eigen::Vector2d::Zero(), beyond(from, over.end + over.fall), beyond(to, over.end),
                     tilt_lag_s_, step_s);
}

bool FilterModel::is_driven_as(const FilterModel& other) const {
  return &vehicle_ == &other.vehicle_ && actuators_ == other.actuators_ &&
         get(calibration_, Nuisance::actuator_delay) == get(other.calibration_, Nuisance::actuator_delay);
}

bool FilterModel::feels_forces(Channel channel) const { return is_force(channel) || age_of(channel) != 0; }

bool FilterModel::is_prompt() const {
  constexpr auto kFirst = static_cast<Eigen::Index>(Nuisance::imu_delay);
  return calibration_.segment<static_cast<Eigen::Index>(Nuisance::actuator_delay) - kFirst>(kFirst).isZero(0);
}

double FilterModel::age_of(Channel channel) const {
  const auto delay = delay_of(channel);
  return delay ? get(calibration_, *delay) : 0;
}

MotionPoint FilterModel::before(MotionPoint point, double age_s) const {
  // Midpoint rule: a vehicle that starts to turn is not yet turning as fast.
  sim::Body middle = point.body;
  const auto back = [&](sim::Body& body, const sim::Body& by, double seconds) {
    const Eigen::Vector3d v = by.velocity.head<3>(), omega = by.velocity.tail<3>();
    const double sr = std::sin(by.euler_rad.x()), cr = std::cos(by.euler_rad.x());
    const double turn = (sr * omega.y() + cr * omega.z()) / std::cos(by.euler_rad.y());
    body.position_m -= seconds * (world_from_body(by.euler_rad) * v + current());
    body.euler_rad -= seconds * Eigen::Vector3d(omega.x() + std::sin(by.euler_rad.y()) * turn,
                                                cr * omega.y() - sr * omega.z(), turn);
    body.velocity -= seconds * point.acceleration;
  };
  back(middle, point.body, age_s / 2);
  back(point.body, middle, age_s);
  return point;
}

std::unique_ptr<const sim::LayoutVehicle::Held> FilterModel::held_for(std::span<const ChannelReading> readings,
                                                                      double time_s) const {
  for (const ChannelReading& reading : readings) {
    if (!feels_forces(reading.channel)) continue;
    sim::ActuatorValues values = sim::ActuatorValues::neutral(vehicle_.layout());
    actuators_->at(time_s - age_of(Channel::force_x) - get(calibration_, Nuisance::actuator_delay), values);
    return std::unique_ptr<const sim::LayoutVehicle::Held>(new sim::LayoutVehicle::Held(vehicle_.hold(values)));
  }
  return nullptr;
}

FilterState FilterModel::after(const FilterState& state, const Moved& moved, double step_s, double tau_s) const {
  sim::Body body = point_of(state.head<kStates>()).body;
  const sim::Vector6 kick = step_s / 2 * state.tail<6>();
  body.velocity += kick;
  body = vehicle_.moved_step(body, moved.begin, moved.middle, moved.end, step_s).body;
  body.velocity += kick;
  body.position_m += step_s * current();
  Eigen::Vector2d felt_before = state.segment<2>(kEuler), felt = body.euler_rad.head<2>();
  if (errors_.has_felt_tilt()) {
    const auto beyond = [&](const sim::Body& at, const sim::LayoutVehicle::Held& held) {
      return errors_.felt_tilt(at, vehicle_.acceleration(at, held) + state.tail<6>());
    };
    felt_before += beyond(point_of(state.head<kStates>()).body, moved.begin);
    felt += beyond(body, moved.end);
  }
  FilterState end;
  end << body.position_m, body.euler_rad, body.velocity,
      lagged_tilt(state.segment<2>(kTilt), felt_before, felt, tilt_lag_s_, step_s),
      std::exp(-step_s / tau_s) * state.tail<6>();
  return end;
}

StepDerivatives FilterModel::derivatives(const FilterState& state, const FilterState& stds, const FilterState& end,
                                         const Moved& actuators, double step_s, double tau_s) const {
  StepDerivatives all = StepDerivatives::Zero();
  for (Eigen::Index i = 0; i < all.cols(); ++i) {
    if (i == 2) continue;
    FilterState moved = state;
    const double difference = difference_for(stds[kEuler + i]);
    moved[kEuler + i] += difference;
    all.col(i) = (after(moved, actuators, step_s, tau_s) - end).head<kStates>() / difference;
  }
  // Yaw turns the way that the vehicle goes through the water, and nothing else.
  all(0, 2) = -(end[1] - state[1] - step_s * current().y());
  all(1, 2) = end[0] - state[0] - step_s * current().x();
  all(5, 2) = 1;
  return all;
}

Transition::Transition(const StepDerivatives& derivatives, double tilt_lag_s, double step_s, double tau_s)
    : derivatives_(derivatives), half_step_s_(step_s / 2),
      tilt_left_(tilt_lag_s > 0 ? std::exp(-step_s / tilt_lag_s) : 0),
      disturbance_left_(std::exp(-step_s / tau_s)) {}

FilterState Transition::operator*(const FilterState& x) const {
  return (FilterState() << motion<1>(derivatives_, half_step_s_, tilt_left_, x), disturbance_left_ * x.tail<6>())
      .finished();
}

FilterMatrix Transition::on_both_sides_of(const FilterMatrix& covariance) const {
  const auto across = motion<kFilterStates>(derivatives_, half_step_s_, tilt_left_, covariance);
  const Eigen::Matrix<double, kStates, kStates> moved =
      motion<kStates>(derivatives_, half_step_s_, tilt_left_, across.transpose());
  FilterMatrix all;
  all.topLeftCorner<kStates, kStates>() = (moved + moved.transpose()) / 2;
  all.topRightCorner<kStates, 6>() = disturbance_left_ * across.rightCols<6>();
  all.bottomLeftCorner<6, kStates>() = all.topRightCorner<kStates, 6>().transpose();
  all.bottomRightCorner<6, 6>() = disturbance_left_ * disturbance_left_ * covariance.bottomRightCorner<6, 6>();
  return all;
}

void FilterModel::predict(const FilterState& state, const sim::LayoutVehicle::Held* held,
                          std::span<const ChannelReading> readings, double* out) const {
  MotionPoint now = point_of(state.head<kStates>());
  if (held != nullptr) now.acceleration = vehicle_.acceleration(now.body, *held) + state.tail<6>();
  predict(now, state, held, readings, out);
}

void FilterModel::predict(const MotionPoint& now, const FilterState& state, const sim::LayoutVehicle::Held* held,
                          std::span<const ChannelReading> readings, double* out) const {
  for (std::size_t first = 0, end = 0; first < readings.size(); first = end) {
    const double age_s = age_of(readings[first].channel);
    bool is_felt = false;
    for (; end < readings.size() && age_of(readings[end].channel) == age_s; ++end)
      is_felt = is_felt || is_force(readings[end].channel);
    MotionPoint then = age_s == 0 ? now : before(now, age_s);
    if (age_s != 0 && is_felt) then.acceleration = vehicle_.acceleration(then.body, *held) + state.tail<6>();
    instruments_.at(then, Eigen::Vector3d::Zero(), readings.subspan(first, end - first), calibration_,
                    out + first);
  }
}

void FilterModel::innovations(const FilterState& state, double time_s, std::span<const ChannelReading> readings,
                              double* out, const sim::Vector6* acceleration) const {
  if (acceleration != nullptr) {
    MotionPoint now = point_of(state.head<kStates>());
    now.acceleration = *acceleration + state.tail<6>();
    predict(now, state, nullptr, readings, out);
  } else {
    predict(state, held_for(readings, time_s).get(), readings, out);
  }
  for (std::size_t i = 0; i < readings.size(); ++i) out[i] = difference_of(readings[i], readings[i].value, out[i]);
}

void FilterModel::sensitivities(const FilterState& state, const FilterState& stds, double time_s,
                                std::span<const ChannelReading> readings, std::span<FilterState> out) const {
  const auto held = held_for(readings, time_s);
  std::fill(out.begin(), out.end(), FilterState::Zero());
  std::vector<double> here(readings.size()), there(readings.size());
  predict(state, held.get(), readings, here.data());
  for (Eigen::Index s = 0; s < (held ? kFilterStates : kStates); ++s) {
    FilterState moved = state;
    const double difference = difference_for(stds[s]);
    moved[s] += difference;
    predict(moved, held.get(), readings, there.data());
    for (std::size_t i = 0; i < readings.size(); ++i)
      out[i][s] = difference_of(readings[i], there[i], here[i]) / difference;
  }
}

}  // namespace navcal::identify
