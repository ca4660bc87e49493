// SPDX-License-Identifier: Apache-2.0
#include "identify/conventions/agreement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/angles.h"
#include "base/gravity.h"
#include "identify/data/gridded.h"
#include "identify/replay/motion_point.h"

namespace navcal::identify {

const std::array<RelationDescription, kRelations> kRelationDescriptions{
    {{"change of roll", "rad", 0.01, 0.02},
     {"change of pitch", "rad", 0.01, 0.02},
     {"change of heading", "rad", 0.01, 0.02},
     {"turn by the second gyro", "rad", 0.005, 0.02},
     {"specific force x", "m/s2", 0.05, 0.3},
     {"specific force y", "m/s2", 0.05, 0.3},
     {"specific force z", "m/s2", 0.05, 0.3},
     {"change of depth", "m", 0.02, 0.04},
     {"change of the gauge's depth", "m", 0.02, 0.04},
     {"way north", "m", 0.1, 0.2},
     {"way east", "m", 0.1, 0.2},
     {"way north by the receiver's velocity", "m", 0.3, 0.2},
     {"way east by the receiver's velocity", "m", 0.3, 0.2},
     {"response ahead", "m/s", 0.02, 0.01},
     {"response to the side", "m/s", 0.02, 0.05},
     {"response downwards", "m/s", 0.02, 0.05},
     {"response in roll rate", "rad/s", 0.02, 0.02},
     {"response in pitch rate", "rad/s", 0.01, 0.02},
     {"response in yaw rate", "rad/s", 0.01, 0.02}}};

namespace {

constexpr std::size_t kWindow = 20;  ///< steps of the grid
constexpr int kModelSteps = 2;       ///< in one of the grid
constexpr double kWindow_s = kWindow * kGrid_s;
constexpr double kSteepestPitch_rad = 1.3;
constexpr double kSmall = 1e-12;
constexpr double kMostTurn_rad = 0.7;  ///< declination and deviation of a compass are less

/// Steps of the grid in which actuators tell: 1 s for a vehicle of half a metre, by Froude's law for others.
std::size_t response_of(const config::Layout& layout) {
  constexpr double kLeast_s = 1, kMost_s = 10, kLength_m = 0.5;
  const double time_s = std::clamp(std::sqrt(layout.body.size_m[0] / kLength_m), kLeast_s, kMost_s);
  return static_cast<std::size_t>(std::lround(time_s / kGrid_s));
}

/// Most that the noise of the grid's velocity varies: two standard errors of the variance of so many readings
/// beyond it, m2/s2.
double most_noise(const RecordedMotion& motion, const GriddedMotion& grid) {
  const auto& readings = motion[grid.velocity_from];
  const double n = std::max(1.0, static_cast<double>(readings.size()));
  double variance = 0;
  for (const Reading& reading : readings) variance += reading.std * reading.std / n;
  if (grid.velocity_from == Channel::north) variance *= 2 / (GriddedMotion::kSlope_s * GriddedMotion::kSlope_s);
  return variance * (1 + 2 * std::sqrt(2 / n));
}

/// Velocities at the starts of responses: the measured ones, moved by the share of their noise towards the mean
/// ahead and to nothing sideways. A vehicle unstable in yaw would turn by the noise of its sway. NaN where
/// unmeasured.
std::vector<Eigen::Vector3d> likely_velocities(const GriddedMotion& grid, double noise_m2_s2) {
  std::vector<Eigen::Vector3d> out = grid.velocity;
  Eigen::Array3d usual = Eigen::Array3d::Zero(), squares = usual;
  double count = kSmall;
  for (const Eigen::Vector3d& velocity : out) {
    if (!velocity.allFinite()) continue;
    usual.x() += velocity.x();
    squares += velocity.array().square();
    ++count;
  }
  usual /= count;
  const Eigen::Array3d spread = squares / count - usual.square();
  const Eigen::Array3d share = (1 - noise_m2_s2 / spread.max(kSmall)).max(0);
  for (Eigen::Vector3d& velocity : out) velocity = usual + share * (velocity.array() - usual);
  return out;
}

/// Residuals of one relation, window by window.
class Gathered {
 public:
  void add(double residual) {
    if (std::isfinite(residual)) all_.push_back(residual);
  }
  [[nodiscard]] Residual residual(const RelationDescription& of) const {
    constexpr std::size_t kFewest = 5;
    if (all_.size() < kFewest) return {};
    const auto n = static_cast<double>(all_.size());
    double sum = 0, squares = 0, fourths = 0;
    for (const double e : all_) sum += e;
    const double mean = sum / n, news = std::copysign(std::max(0.0, std::abs(mean) - of.allowance), mean);
    for (const double e : all_) {
      const double square = std::pow(e - mean + news, 2) + of.floor * of.floor;
      squares += square;
      fourths += square * square;
    }
    return {squares / n, squares * squares / fourths, all_.size()};
  }

 private:
  std::vector<double> all_;
};

/// All relations of one motion.
class Relations {
 public:
  Relations(const RecordedMotion& motion) : motion_(motion), grid_(motion, Channel::bottom_x) {}

  void kinematics() {
    for (std::size_t k = 0; k + kWindow < grid_.rows; k += kWindow) window(k, k + kWindow);
    track();
  }
  void response(const sim::LayoutVehicle& vehicle, const ActuatorTrajectory& actuators,
                const ActuatorChange& change) {
    response_ = response_of(vehicle.layout());
    velocity_m_s_ = likely_velocities(grid_, most_noise(motion_, grid_));
    for (std::size_t k = 0; k + response_ < grid_.rows; k += response_) respond(vehicle, actuators, change, k);
    respond_all();
  }
  [[nodiscard]] Agreement agreement() const {
    Agreement out = agreement_;
    for (std::size_t i = 0; i < kRelations; ++i) out.of[i] = all_[i].residual(kRelationDescriptions[i]);
    return out;
  }

 private:
  Gathered& operator[](Relation relation) { return all_[static_cast<std::size_t>(relation)]; }
  Gathered& axis(Relation first, Eigen::Index i) {
    return all_[static_cast<std::size_t>(first) + static_cast<std::size_t>(i)];
  }
  void window(std::size_t begin, std::size_t end) {
    Eigen::Vector3d turned = Eigen::Vector3d::Zero(), way = turned, force = turned, fixes = turned;
    double second = 0;
    for (std::size_t k = begin; k <= end; ++k) {
      const double step_s = k == begin || k == end ? kGrid_s / 2 : kGrid_s;
      const Eigen::Vector3d euler = grid_.euler(k), omega = grid_.rates[k];
      const double roll = euler.x(), tilt = std::tan(euler.y());
      if (std::abs(euler.y()) > std::numbers::pi / 2) (*this)[Relation::pitch].add(euler.y());  // no such angle
      if (std::abs(euler.y()) > kSteepestPitch_rad) return;
      const double across = std::sin(roll) * omega.y() + std::cos(roll) * omega.z();
      turned += step_s * Eigen::Vector3d(omega.x() + tilt * across,
                                         std::cos(roll) * omega.y() - std::sin(roll) * omega.z(),
                                         across / std::cos(euler.y()));
      second += step_s * (omega.z() - grid_.at(Channel::second_yaw_rate, k));
      const Eigen::Matrix3d world = world_from_body(euler);
      Eigen::Vector3d speed = grid_.velocity[k];
      const Eigen::Vector3d over(grid_.at(Channel::north_velocity, k), grid_.at(Channel::east_velocity, k), 0);
      fixes += step_s * over;
      // Without a Doppler log the vehicle is taken to go where its bow points.
      way += step_s * (world * (grid_.has_doppler ? speed : Eigen::Vector3d(over.norm(), 0, 0)));
      if (!grid_.has_doppler) speed.setZero();
      force += step_s * (grid_.three(Channel::force_x, k) - omega.cross(omega.cross(motion_.imu_place_m)) +
                         world.transpose() * Eigen::Vector3d(0, 0, base::kGravity_m_s2) - omega.cross(speed));
    }
    if (grid_.has_gyros) {
      for (Eigen::Index i = 0; i < 3; ++i) {
        const auto angle =
            static_cast<Channel>(static_cast<std::size_t>(Channel::roll) + static_cast<std::size_t>(i));
        axis(Relation::roll, i).add(base::wrapped(grid_.change(angle, begin, end) - turned[i]));
      }
      (*this)[Relation::second_gyro].add(second);
    }
    if (grid_.has_tilt) {
      force -= (grid_.rates[end] - grid_.rates[begin]).cross(motion_.imu_place_m);
      if (grid_.has_doppler) force -= grid_.velocity[end] - grid_.velocity[begin];
      for (Eigen::Index i = 0; i < 3; ++i) axis(Relation::force_x, i).add(force[i] / kWindow_s);
    }
    const auto lever = [&](const Eigen::Vector3d& place_m) -> Eigen::Vector3d {
      return world_from_body(grid_.euler(end)) * place_m - world_from_body(grid_.euler(begin)) * place_m;
    };
    if (grid_.has_doppler) {
      (*this)[Relation::depth].add(grid_.change(Channel::depth, begin, end) - lever(motion_.imu_place_m).z() -
                                   way.z());
      (*this)[Relation::gauge_depth].add(grid_.change(Channel::gauge_depth, begin, end) -
                                         lever(motion_.gauge_place_m).z() - way.z());
    }
    const double north = grid_.change(Channel::north, begin, end), east = grid_.change(Channel::east, begin, end);
    (*this)[Relation::fix_north].add(north - fixes.x());
    (*this)[Relation::fix_east].add(east - fixes.y());
    const Eigen::Vector3d arm = lever(motion_.antenna_place_m);
    const std::complex<double> measured(north - arm.x(), east - arm.y()), by_body(way.x(), way.y());
    if (!std::isfinite(std::abs(measured)) || !std::isfinite(std::abs(by_body)) || !motion_.has(Channel::heading))
      return;
    ways_.push_back(measured);
    reckoned_.push_back(by_body);
  }
  void track() {
    // measured = current + turn by_body: by least squares; a current only where velocity is not over the bottom.
    std::complex<double> mean_way = 0, mean_reckoned = 0, product = 0;
    const auto n = static_cast<double>(ways_.size());
    if (!grid_.by_bottom) {
      for (std::size_t i = 0; i < ways_.size(); ++i) {
        mean_way += ways_[i] / n;
        mean_reckoned += reckoned_[i] / n;
      }
    }
    double length = 0;
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      product += std::conj(reckoned_[i] - mean_reckoned) * (ways_[i] - mean_way);
      length += std::norm(reckoned_[i] - mean_reckoned);
    }
    if (ways_.empty() || length <= 0) return;
    const double turn = std::arg(product);
    const auto by = std::polar(1.0, std::clamp(turn, -kMostTurn_rad, kMostTurn_rad));
    double squares = 0;
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      const auto left = ways_[i] - mean_way - by * (reckoned_[i] - mean_reckoned);
      (*this)[Relation::north].add(left.real());
      (*this)[Relation::east].add(left.imag());
      squares += std::norm(left);
    }
    agreement_.track_turn_rad = turn;
    agreement_.track_turn_std_rad = std::sqrt(squares / n / length);
  }
  void respond(const sim::LayoutVehicle& vehicle, const ActuatorTrajectory& actuators,
               const ActuatorChange& change, std::size_t begin) {
    const bool has_velocity = grid_.velocity[begin].allFinite();
    sim::Body body;
    body.position_m = {0, 0, 10};  // away from the surface
    body.euler_rad = grid_.euler(begin);
    body.velocity << (has_velocity ? velocity_m_s_[begin] : Eigen::Vector3d::Zero().eval()), grid_.rates[begin];
    if (!body.velocity.allFinite() || !body.euler_rad.allFinite() || !is_sane(body)) return;
    const double step_s = kGrid_s / kModelSteps;
    sim::Body driven = body, drifting = body;
    const sim::ActuatorValues neutral = sim::ActuatorValues::neutral(vehicle.layout());
    sim::ActuatorValues positions = neutral;
    for (std::size_t i = 0; i < response_ * kModelSteps; ++i) {
      actuators.mean(kGrid_s * static_cast<double>(begin) + step_s * static_cast<double>(i), step_s, positions);
      change(positions);
      driven = vehicle.step(driven, positions, step_s).body;
      drifting = vehicle.step(drifting, neutral, step_s).body;
      if (!is_sane(driven) || !is_sane(drifting)) return;
    }
    sim::Vector6 measured;
    measured << (has_velocity ? grid_.velocity[begin + response_] : Eigen::Vector3d::Constant(kUnknown).eval()),
        grid_.rates[begin + response_];
    left_.emplace_back(measured - drifting.velocity, driven.velocity - drifting.velocity);
  }
  void respond_all() {
    // measured - drifting = scale (driven - drifting): a layout may have its forces wrong, but not their signs.
    constexpr double kMostScale = 2;
    for (Eigen::Index i = 0; i < 6; ++i) {
      double squares = 0, products = 0;
      for (const auto& [measured, caused] : left_) {
        if (!std::isfinite(measured[i])) continue;
        squares += caused[i] * caused[i];
        products += caused[i] * measured[i];
      }
      const double scale = squares > 0 ? std::clamp(products / squares, 0.0, kMostScale) : 0;
      for (const auto& [measured, caused] : left_) axis(Relation::surge, i).add(measured[i] - scale * caused[i]);
    }
  }

  const RecordedMotion& motion_;
  GriddedMotion grid_;
  std::vector<Eigen::Vector3d> velocity_m_s_;  ///< at the starts of responses
  std::array<Gathered, kRelations> all_;
  std::vector<std::complex<double>> ways_, reckoned_;  ///< north + i east, of the windows
  std::size_t response_ = 0;                           ///< steps of the grid
  std::vector<std::pair<sim::Vector6, sim::Vector6>>
      left_;  ///< change beside that without actuators: measured, by the layout
  Agreement agreement_;
};

}  // namespace

Agreement agreement_of(const sim::LayoutVehicle& vehicle, const RecordedMotion& motion,
                       const ActuatorTrajectory* actuators, const ActuatorChange& change) {
  Relations relations(motion);
  relations.kinematics();
  if (actuators != nullptr) relations.response(vehicle, *actuators, change);
  return relations.agreement();
}

}  // namespace navcal::identify
