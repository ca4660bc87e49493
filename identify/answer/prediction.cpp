// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/prediction.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "base/angles.h"
#include "identify/data/actuator_inputs.h"
#include "identify/data/gridded.h"
#include "identify/replay/motion_point.h"

namespace navcal::identify {
namespace {

constexpr int kLayoutSteps = 5;  ///< of the layout's vehicle, in one of the grid
constexpr double kModelStep_s = kGrid_s / kLayoutSteps;
constexpr std::ptrdiff_t kSlopeSteps = 3;  ///< steps of the grid before and behind, for a derivative
constexpr std::array<std::size_t, 3> kAfter{10, 100, 600};  ///< steps of the grid
constexpr double kSteered = 3;

/// The body a step later at this velocity, whose derivative is given.
sim::Body moved(const sim::Body& body, const sim::Vector6& acceleration, double step_s) {
  sim::Body next = body;
  next.velocity += step_s * acceleration;
  const sim::Vector6 mean = (body.velocity + next.velocity) / 2;
  const double roll = body.euler_rad.x(), tilt = std::tan(body.euler_rad.y());
  const double across = std::sin(roll) * mean[4] + std::cos(roll) * mean[5];
  next.position_m += step_s * world_from_body(body.euler_rad) * mean.head<3>();
  next.euler_rad +=
      step_s * Eigen::Vector3d(mean[3] + tilt * across, std::cos(roll) * mean[4] - std::sin(roll) * mean[5],
                               across / std::cos(body.euler_rad.y()));
  return next;
}

/// Motion on the grid as one recording measured it, and the positions of its actuators.
struct Track {
  std::vector<sim::Body> bodies;  ///< NaN where it is not measured
  ActuatorTrajectory actuators;
  bool has_depth = false, by_fixes = false;

  Track(const config::Layout& layout, const RecordedMotion& motion);
  [[nodiscard]] bool is_measured(std::size_t k) const {
    return k < bodies.size() && bodies[k].position_m.allFinite() && bodies[k].velocity.allFinite() &&
           bodies[k].euler_rad.allFinite();
  }
  [[nodiscard]] sim::Vector6 acceleration(std::size_t k) const {
    return (bodies[k + kSlopeSteps].velocity - bodies[k - kSlopeSteps].velocity) / (2 * kSlopeSteps * kGrid_s);
  }
};

Track::Track(const config::Layout& layout, const RecordedMotion& motion) {
  const ActuatorInputs inputs(layout, motion);
  if (!inputs.missing().empty()) throw std::invalid_argument(motion.name + ": " + inputs.missing().front());
  if (!motion.has(Channel::heading)) throw std::invalid_argument(motion.name + ": no heading is recorded");
  actuators = inputs.trajectory(layout);
  const GriddedMotion grid(motion, Channel::water_x);
  if (!grid.has_velocity)
    throw std::invalid_argument(motion.name + ": no Doppler log and no fixes: nothing measures the velocity");
  const Channel depth = motion.has(Channel::gauge_depth) ? Channel::gauge_depth : Channel::depth;
  has_depth = motion.has(depth);
  by_fixes = motion.has(Channel::north) && motion.has(Channel::east);
  Eigen::Vector2d reckoned = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < grid.rows; ++k) {
    sim::Body body;
    body.euler_rad = grid.euler(k);
    body.velocity << grid.velocity[k], grid.rates[k];
    body.position_m = {reckoned.x(), reckoned.y(), grid.or_zero(depth, k)};
    if (by_fixes) body.position_m.head<2>() << grid.at(Channel::north, k), grid.at(Channel::east, k);
    // A silence begins a new track; no prediction reaches over it.
    reckoned += kGrid_s * (world_from_body(body.euler_rad) * grid.velocity[k]).head<2>();
    if (!reckoned.allFinite()) reckoned.setZero();
    bodies.push_back(body);
  }
}

/// Accelerations by least squares on what was measured.
class Regression {
 public:
  Regression(const config::Layout& layout, const std::vector<Track>& tracks, bool is_quadratic)
      : layout_(layout), is_quadratic_(is_quadratic) {
    Eigen::MatrixXd squares, products;
    for (const Track& track : tracks) {
      for (std::size_t k = kSlopeSteps; k + kSlopeSteps < track.bodies.size(); ++k) {
        if (!track.is_measured(k) || !track.is_measured(k - kSlopeSteps) || !track.is_measured(k + kSlopeSteps))
          continue;
        const Eigen::VectorXd row = terms(track.bodies[k], track.actuators, kGrid_s * static_cast<double>(k));
        if (squares.size() == 0) {
          squares = Eigen::MatrixXd::Zero(row.size(), row.size());
          products = Eigen::MatrixXd::Zero(row.size(), 6);
        }
        squares += row * row.transpose();
        products += row * track.acceleration(k).transpose();
      }
    }
    if (squares.size() == 0)
      throw std::invalid_argument("--fit: nowhere are commands and motion measured together");
    // Terms that never changed count for nothing.
    constexpr double kRidge = 1e-8;
    const Eigen::VectorXd scale = squares.diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd scaled = scale.asDiagonal() * squares * scale.asDiagonal();
    scaled.diagonal().array() += kRidge;
    coefficients_ = (scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * products)).transpose();
  }

  [[nodiscard]] sim::Vector6 acceleration(const sim::Body& body, const ActuatorTrajectory& actuators,
                                          double time_s) const {
    return coefficients_ * terms(body, actuators, time_s);
  }

 private:
  [[nodiscard]] Eigen::VectorXd terms(const sim::Body& body, const ActuatorTrajectory& actuators,
                                      double time_s) const {
    sim::ActuatorValues positions = sim::ActuatorValues::neutral(layout_);
    actuators.at(time_s, positions);
    std::vector<double> all(body.velocity.begin(), body.velocity.end());
    for (const auto* part :
         {&positions.thrusters, &positions.surfaces_rad, &positions.ballasts_N, &positions.masses_m})
      all.insert(all.end(), part->begin(), part->end());
    const std::size_t plain = all.size();
    const double u = body.velocity[0];
    if (is_quadratic_) {
      for (std::size_t i = 0; i < plain; ++i) {
        all.push_back(all[i] * std::abs(all[i]));
        if (i > 0) all.push_back(all[i] * u);
        if (i >= 6) all.push_back(all[i] * u * std::abs(u));
      }
      all.push_back(body.velocity[1] * body.velocity[5]);
    }
    all.insert(all.end(), {1, std::sin(body.euler_rad.x()), std::sin(body.euler_rad.y())});
    return Eigen::Map<Eigen::VectorXd>(all.data(), std::ssize(all));
  }

  const config::Layout& layout_;
  bool is_quadratic_;
  Eigen::MatrixXd coefficients_;
};

class Sums {
 public:
  void add(Predictor by, const sim::Body& predicted, const sim::Body& measured) {
    const auto i = static_cast<std::size_t>(by);
    const auto velocity = predicted.velocity - measured.velocity;
    position_[i] += (predicted.position_m - measured.position_m).head<2>().squaredNorm();
    heading_[i] += std::pow(base::wrapped(predicted.euler_rad.z() - measured.euler_rad.z()), 2);
    depth_[i] += std::pow(predicted.position_m.z() - measured.position_m.z(), 2);
    velocity_[i] += velocity.head<3>().squaredNorm();
  }
  void put(PredictionErrors& out, bool has_regressions, bool has_depth) const {
    if (out.starts == 0) return;
    const auto rms = [&](double sum) { return std::sqrt(sum / static_cast<double>(out.starts)); };
    for (std::size_t i = 0; i < kPredictors.size(); ++i) {
      if (!has_regressions && i >= static_cast<std::size_t>(Predictor::linear)) continue;
      out.position_m[i] = rms(position_[i]);
      out.heading_rad[i] = rms(heading_[i]);
      if (has_depth) out.depth_m[i] = rms(depth_[i]);
      out.velocity_m_s[i] = rms(velocity_[i]);
    }
  }

 private:
  using Row = std::array<double, kPredictors.size()>;
  Row position_{}, heading_{}, depth_{}, velocity_{};
};

double of(const PredictionErrors::Row& row, Predictor by) {
  return row[static_cast<std::size_t>(by)].value_or(std::numeric_limits<double>::infinity());
}

void judge(Prediction& all) {
  const PredictionErrors& farthest = all.errors[2].starts > 0 ? all.errors[2] : all.errors[1];
  const double other =
      std::min(of(farthest.position_m, Predictor::hold), of(farthest.position_m, Predictor::linear));
  all.is_steered = farthest.starts > 0 && of(farthest.position_m, Predictor::still) < kSteered * other;
  all.by_velocity = all.is_steered || all.errors[1].starts == 0;
  const auto& row = all.by_velocity ? all.errors[0].velocity_m_s : all.errors[1].position_m;
  all.layout_error = of(row, Predictor::layout);
  all.worse_than_linear = all.layout_error > of(row, Predictor::linear);
  all.worse_than_hold = all.layout_error > of(row, Predictor::hold);
}

/// The ways to predict that there are.
struct Predictors {
  const sim::LayoutVehicle& vehicle;
  std::optional<Regression> linear, quadratic;
};

/// All predictions from one measured state.
class Forecast {
 public:
  explicit Forecast(const sim::Body& begin) {
    now_.fill(begin);
    (*this)[Predictor::still].velocity.setZero();
  }
  /// A step of the grid on.
  void advance(const Predictors& by, const ActuatorTrajectory& actuators, double time_s) {
    move((*this)[Predictor::hold], sim::Vector6::Zero());
    const auto follow = [&](Predictor predictor, const std::optional<Regression>& regression) {
      sim::Body& body = (*this)[predictor];
      if (regression) move(body, regression->acceleration(body, actuators, time_s + kGrid_s / 2));
    };
    follow(Predictor::linear, by.linear);
    follow(Predictor::quadratic, by.quadratic);
    sim::ActuatorValues positions = sim::ActuatorValues::neutral(by.vehicle.layout());
    for (int i = 0; i < kLayoutSteps && is_sound_; ++i) {
      actuators.mean(time_s + i * kModelStep_s, kModelStep_s, positions);
      const sim::Body next = by.vehicle.step((*this)[Predictor::layout], positions, kModelStep_s).body;
      is_sound_ = is_sane(next);
      if (is_sound_) (*this)[Predictor::layout] = next;
    }
  }
  sim::Body& operator[](Predictor predictor) { return now_[static_cast<std::size_t>(predictor)]; }
  [[nodiscard]] bool is_sound() const { return is_sound_; }  ///< the layout's vehicle has left no bounds

 private:
  static void move(sim::Body& body, const sim::Vector6& acceleration) {
    const sim::Body next = moved(body, acceleration, kGrid_s);
    if (is_sane(next)) body = next;
  }

  std::array<sim::Body, kPredictors.size()> now_;
  bool is_sound_ = true;
};

/// Says what is missing.
std::invalid_argument not_measured(std::span<const Track> tracks) {
  double attitude = 0, velocity = 0, position = 0, rows = 0;
  for (const Track& track : tracks) {
    for (const sim::Body& body : track.bodies) {
      attitude += body.euler_rad.allFinite() ? 100 : 0;
      velocity += body.velocity.allFinite() ? 100 : 0;
      position += body.position_m.allFinite() ? 100 : 0;
      ++rows;
    }
  }
  return std::invalid_argument(fmt::format(
      "predictions need attitude, velocity and position for a second on end: they are measured {:.0f}, "
      "{:.0f} and {:.0f} % of the time (readings more than {:g} s apart are not joined)",
      attitude / rows, velocity / rows, position / rows, kGap_s));
}

}  // namespace

Prediction predict(const PredictionRequest& request, const std::function<void(double)>& progress) {
  std::vector<Track> fitted, judged;
  for (const RecordedMotion& motion : request.fit) fitted.emplace_back(request.layout, motion);
  for (const RecordedMotion& motion : request.recordings) judged.emplace_back(request.layout, motion);
  const sim::LayoutVehicle vehicle(request.layout);
  Predictors by{vehicle, {}, {}};
  if (!fitted.empty()) {
    by.linear.emplace(request.layout, fitted, false);
    by.quadratic.emplace(request.layout, fitted, true);
  }
  Prediction all;
  std::array<Sums, kAfter.size()> sums;
  for (std::size_t i = 0; i < kAfter.size(); ++i) all.errors[i].after_s = kGrid_s * static_cast<double>(kAfter[i]);
  const auto forecast_from = [&](const Track& track, std::size_t start) {
    Forecast forecast(track.bodies[start]);
    for (std::size_t step = 1; step <= kAfter.back() && track.is_measured(start + step); ++step) {
      forecast.advance(by, track.actuators, kGrid_s * static_cast<double>(start + step - 1));
      const auto due = std::ranges::find(kAfter, step);
      if (due == kAfter.end()) continue;
      const auto i = static_cast<std::size_t>(due - kAfter.begin());
      ++all.errors[i].starts;
      for (std::size_t p = 0; p < kPredictors.size(); ++p) {
        const auto predictor = static_cast<Predictor>(p);
        sums[i].add(predictor, forecast[predictor], track.bodies[start + step]);
      }
    }
    if (!forecast.is_sound()) ++all.diverged;
  };
  const auto spacing = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(request.every_s / kGrid_s)));
  for (std::size_t t = 0; t < judged.size(); ++t) {
    const auto rows = judged[t].bodies.size();
    for (std::size_t start = 0; start < rows; start += spacing) {
      progress((static_cast<double>(t) + static_cast<double>(start) / static_cast<double>(rows)) /
               static_cast<double>(judged.size()));
      if (judged[t].is_measured(start)) forecast_from(judged[t], start);
    }
  }
  if (all.errors[0].starts == 0) throw not_measured(judged);
  const auto have = [&](bool Track::*what) {
    return std::ranges::all_of(judged, [&](const Track& track) { return track.*what; });
  };
  all.by_fixes = have(&Track::by_fixes);
  for (std::size_t i = 0; i < kAfter.size(); ++i)
    sums[i].put(all.errors[i], by.linear.has_value(), have(&Track::has_depth));
  judge(all);
  return all;
}

}  // namespace navcal::identify
