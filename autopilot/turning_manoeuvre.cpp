// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "autopilot/manoeuvre.h"

namespace navcal::autopilot {
namespace {

using config::MissionStep;

constexpr double kUsualRate_rad_s = 20 * std::numbers::pi / 180;

/// The heading wanted moves through an angle at a rate, and waits for a vehicle that does not follow.
class Ramp {
 public:
  Ramp(double angle_rad, double rate_rad_s) : angle_rad_(angle_rad), rate_rad_s_(rate_rad_s) {}

  /// False: the angle is done, or three times the time for it is over.
  bool go_on(const Situation& now, double since_s, Demand& demand) {
    constexpr double kFarthestAhead_rad = 0.8;
    const double left_rad = angle_rad_ - done_rad_;
    const bool over = since_s > 3 * std::abs(angle_rad_) / rate_rad_s_ + 10;
    if (left_rad == 0 || over) {
      demand.turn_rad_s = 0;
      return false;
    }
    demand.turn_rad_s = std::copysign(rate_rad_s_, left_rad);
    if (std::abs(demand.heading_rad - now.state.euler_rad[2]) > kFarthestAhead_rad) return true;
    const double step_rad = std::clamp(left_rad, -rate_rad_s_ * now.period_s, rate_rad_s_ * now.period_s);
    done_rad_ += step_rad;
    demand.heading_rad += step_rad;
    return true;
  }
  [[nodiscard]] double share() const { return angle_rad_ == 0 ? 1 : done_rad_ / angle_rad_; }

 private:
  double angle_rad_;
  double rate_rad_s_;
  double done_rad_ = 0;
};

/// Turn and circle; of a spiral the depth too moves, evenly.
class Turn final : public Manoeuvre {
 public:
  explicit Turn(const MissionStep& step) : step_(step), ramp_(0, kUsualRate_rad_s) {}

  void begin(const Situation& /*now*/, Demand& demand) override {
    double angle_rad = step_.by_rad.value_or(2 * std::numbers::pi * step_.turns.value_or(0));
    if (step_.heading_rad) {
      angle_rad = nearest_heading(*step_.heading_rad, demand.heading_rad) - demand.heading_rad;
    }
    ramp_ = Ramp(angle_rad, step_.rate_rad_s.value_or(kUsualRate_rad_s));
    first_depth_m_ = demand.depth_m;
  }

  bool go_on(const Situation& now, Demand& demand) override {
    const bool more = ramp_.go_on(now, now.since_s, demand);
    const double share = step_.kind == config::StepKind::spiral ? ramp_.share() : 1;
    if (step_.depth_m) demand.depth_m = first_depth_m_ + share * (*step_.depth_m - first_depth_m_);
    return more;
  }

 private:
  MissionStep step_;
  Ramp ramp_;
  double first_depth_m_ = 0;
};

/// A station, a turn to the next, and so all round.
class Swing final : public Manoeuvre {
 public:
  explicit Swing(const MissionStep& step) : step_(step), ramp_(0, kUsualRate_rad_s) {}

  void begin(const Situation& /*now*/, Demand& demand) override {
    demand.depth_m = step_.depth_m.value_or(demand.depth_m);
  }

  bool go_on(const Situation& now, Demand& demand) override {
    if (turning_) {
      turning_ = ramp_.go_on(now, now.since_s - phase_began_s_, demand);
      if (!turning_) phase_began_s_ = now.since_s;
    }
    if (turning_ || now.since_s - phase_began_s_ < *step_.seconds) return true;
    if (++done_ >= *step_.stations) return false;
    ramp_ = Ramp(2 * std::numbers::pi / *step_.stations, step_.rate_rad_s.value_or(kUsualRate_rad_s));
    phase_began_s_ = now.since_s;
    turning_ = true;
    return true;
  }

 private:
  MissionStep step_;
  Ramp ramp_;
  int done_ = 0;
  bool turning_ = false;
  double phase_began_s_ = 0;
};

}  // namespace

std::unique_ptr<Manoeuvre> make_turning_manoeuvre(const MissionStep& step) {
  if (step.kind == config::StepKind::swing) return std::make_unique<Swing>(step);
  return std::make_unique<Turn>(step);
}

}  // namespace navcal::autopilot
