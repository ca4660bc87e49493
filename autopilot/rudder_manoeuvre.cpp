// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "autopilot/manoeuvre.h"

namespace navcal::autopilot {
namespace {

using config::MissionStep;
using config::Surface;

/// Kempf's: rudder one way until the heading has gone so far to that side, then over, so many times.
class Zigzag final : public Manoeuvre {
 public:
  explicit Zigzag(const MissionStep& step) : step_(step) {}

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
  MissionStep step_;
  double middle_rad_ = 0;
  int reached_ = 0;
  double over_at_s_ = 0;
};

/// One rudder until so many turns are done.
class Pirouette final : public Manoeuvre {
 public:
  explicit Pirouette(const MissionStep& step) : step_(step) {}

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
  MissionStep step_;
  double first_rad_ = 0;
};

/// One surface goes out, over and back, from where it is; heading or depth is held on by what is not moved.
class Doublet final : public Manoeuvre {
 public:
  explicit Doublet(const MissionStep& step) : step_(step) {}

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

  MissionStep step_;
  Orders trim_;
};

/// Fins as stated, or by rudder and elevator; what is not said stays where it is.
class Direct final : public Manoeuvre {
 public:
  explicit Direct(const MissionStep& step) : step_(step) {}

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

 private:
  MissionStep step_;
};

}  // namespace

std::unique_ptr<Manoeuvre> make_rudder_manoeuvre(const MissionStep& step) {
  switch (step.kind) {
    case config::StepKind::zigzag: return std::make_unique<Zigzag>(step);
    case config::StepKind::pirouette: return std::make_unique<Pirouette>(step);
    case config::StepKind::doublet: return std::make_unique<Doublet>(step);
    default: return std::make_unique<Direct>(step);
  }
}

}  // namespace navcal::autopilot
