// SPDX-License-Identifier: Apache-2.0
#include "autopilot/manoeuvre.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::autopilot {
namespace {

using config::Surface;

constexpr double kSurfaceDepth_m = 0.2;
constexpr double kLongestChangeOfDepth_s = 120;

void aim(const config::MissionStep& step, Demand& demand) {
  if (step.heading_rad) demand.heading_rad = nearest_heading(*step.heading_rad, demand.heading_rad);
  if (step.by_rad) demand.heading_rad += *step.by_rad;
}

/// Heading and depth held for a time or a way.
class Leg final : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  void begin(const Situation& /*now*/, Demand& demand) override {
    aim(step_, demand);
    demand.depth_m = step_.depth_m.value_or(demand.depth_m);
  }

  bool go_on(const Situation& now, Demand& /*demand*/) override {
    return step_.seconds ? now.since_s < *step_.seconds : now.way_m < *step_.metres;
  }
};

/// To another depth, or until the time for it is over.
class Dive final : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  void begin(const Situation& /*now*/, Demand& demand) override {
    aim(step_, demand);
    demand.depth_m = *step_.depth_m;
  }

  bool go_on(const Situation& now, Demand& demand) override {
    constexpr double kNear_m = 0.1;
    return std::abs(now.state.depth_m - demand.depth_m) > kNear_m &&
           now.since_s < step_.seconds.value_or(kLongestChangeOfDepth_s);
  }
};

/// Rises to the depth at which GPS is received and stays there for the time of the step.
class Surfacing final : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  void begin(const Situation& /*now*/, Demand& demand) override {
    aim(step_, demand);
    demand.depth_m = kSurfaceDepth_m;
  }

  bool go_on(const Situation& now, Demand& /*demand*/) override {
    constexpr double kHeard_m = 0.3;
    const bool up = now.state.depth_m < kHeard_m || now.since_s > kLongestChangeOfDepth_s;
    if (up && !up_since_s_) up_since_s_ = now.since_s;
    return !up_since_s_ || now.since_s - *up_since_s_ < *step_.seconds;
  }

 private:
  std::optional<double> up_since_s_;
};

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
  using Manoeuvre::Manoeuvre;

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
  Ramp ramp_{0, kUsualRate_rad_s};
  double first_depth_m_ = 0;
};

/// A station, a turn to the next, and so all round.
class Swing final : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

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
  Ramp ramp_{0, kUsualRate_rad_s};
  int done_ = 0;
  bool turning_ = false;
  double phase_began_s_ = 0;
};

/// Kempf's: rudder one way until the heading has gone so far to that side, then over, so many times.
class Zigzag final : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  void begin(const Situation& now, Demand& demand) override {
    middle_rad_ = now.state.euler_rad[2];
    demand.depth_m = step_.depth_m.value_or(demand.depth_m);
    demand.rudder_rad = *step_.rudder_rad;
  }

  bool go_on(const Situation& now, Demand& demand) override {
    constexpr double kLongestReach_s = 60;
    const double gone_rad = std::copysign(1.0, *demand.rudder_rad) * (now.state.euler_rad[2] - middle_rad_);
    if (gone_rad < *step_.reach_rad && now.since_s - over_at_s_ < kLongestReach_s) return true;
    if (++reached_ >= *step_.times) return false;
    demand.rudder_rad = -*demand.rudder_rad;
    over_at_s_ = now.since_s;
    return true;
  }

 private:
  double middle_rad_ = 0;
  int reached_ = 0;
  double over_at_s_ = 0;
};

/// One rudder until so many turns are done.
class Pirouette final : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  void begin(const Situation& now, Demand& demand) override {
    first_rad_ = now.state.euler_rad[2];
    demand.depth_m = step_.depth_m.value_or(demand.depth_m);
    demand.rudder_rad = std::copysign(*step_.rudder_rad, *step_.turns);
  }

  bool go_on(const Situation& now, Demand& /*demand*/) override {
    constexpr double kLongestTurn_s = 60;
    const double turned = std::abs(now.state.euler_rad[2] - first_rad_) / (2 * std::numbers::pi);
    return turned < std::abs(*step_.turns) && now.since_s < kLongestTurn_s * std::abs(*step_.turns);
  }

 private:
  double first_rad_ = 0;
};

/// One surface goes out, over and back, from where it is; heading or depth is held on by what is not moved.
class Doublet final : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  void begin(const Situation& now, Demand& demand) override {
    trim_ = now.last;
    go_on(now, demand);
  }

  bool go_on(const Situation& now, Demand& demand) override {
    const double halves = now.since_s / *step_.seconds;
    const bool more = halves < 2 * step_.times.value_or(1);
    const double out_rad = std::fmod(halves, 2) < 1 ? *step_.amplitude_rad : -*step_.amplitude_rad;
    move(more ? out_rad : 0, demand);
    return more;
  }

 private:
  void move(double out_rad, Demand& demand) const {
    if (step_.on == Surface::rudder) {
      demand.rudder_rad = trim_.rudder_rad + out_rad;
    } else if (step_.on == Surface::elevator) {
      demand.elevator_rad = trim_.elevator_rad + out_rad;
    } else {
      const auto moved = static_cast<std::size_t>(step_.on) - static_cast<std::size_t>(Surface::fin1);
      for (std::size_t i = 0; i < 3; ++i) demand.fins_rad[i] = trim_.fins_rad[static_cast<Eigen::Index>(i)];
      *demand.fins_rad[moved] += out_rad;
    }
  }

  Orders trim_;
};

/// Fins as stated, or by rudder and elevator; what is not said stays where it is.
class Direct final : public Manoeuvre {
 public:
  using Manoeuvre::Manoeuvre;

  void begin(const Situation& now, Demand& demand) override {
    demand.rudder_rad = step_.rudder_rad.value_or(now.last.rudder_rad);
    demand.elevator_rad = step_.elevator_rad.value_or(now.last.elevator_rad);
    const std::array fins{step_.fin1_rad, step_.fin2_rad, step_.fin3_rad};
    for (std::size_t i = 0; i < 3; ++i) {
      if (fins[0] || fins[1] || fins[2])
        demand.fins_rad[i] = fins[i].value_or(now.last.fins_rad[static_cast<Eigen::Index>(i)]);
    }
  }

  bool go_on(const Situation& now, Demand& /*demand*/) override { return now.since_s < *step_.seconds; }
};

}  // namespace

double nearest_heading(double heading_rad, double near_rad) {
  return near_rad + std::remainder(heading_rad - near_rad, 2 * std::numbers::pi);
}

std::unique_ptr<Manoeuvre> make_manoeuvre(const config::MissionStep& step) {
  using config::StepKind;
  switch (step.kind) {
    case StepKind::leg:
    case StepKind::speed: break;
    case StepKind::dive: return std::make_unique<Dive>(step);
    case StepKind::surface: return std::make_unique<Surfacing>(step);
    case StepKind::turn:
    case StepKind::circle:
    case StepKind::spiral: return std::make_unique<Turn>(step);
    case StepKind::swing: return std::make_unique<Swing>(step);
    case StepKind::zigzag: return std::make_unique<Zigzag>(step);
    case StepKind::pirouette: return std::make_unique<Pirouette>(step);
    case StepKind::doublet: return std::make_unique<Doublet>(step);
    case StepKind::direct: return std::make_unique<Direct>(step);
  }
  return std::make_unique<Leg>(step);
}

}  // namespace navcal::autopilot
