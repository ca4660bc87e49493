// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "autopilot/manoeuvre.h"

namespace navcal::autopilot {
namespace {

using config::MissionStep;

constexpr double kSurfaceDepth_m = 0.2;
constexpr double kLongestChangeOfDepth_s = 120;

void aim(const MissionStep& step, Demand& demand) {
  if (step.heading_rad) demand.heading_rad = nearest_heading(*step.heading_rad, demand.heading_rad);
  if (step.by_rad) demand.heading_rad += *step.by_rad;
}

/// Heading and depth held for a time or a way.
class Leg final : public Manoeuvre {
 public:
  explicit Leg(const MissionStep& step) : step_(step) {}

  void begin(const Situation& /*now*/, Demand& demand) override {
    aim(step_, demand);
    demand.depth_m = step_.depth_m.value_or(demand.depth_m);
  }

  bool go_on(const Situation& now, Demand& /*demand*/) override {
    return step_.seconds ? now.since_s < *step_.seconds : now.way_m < *step_.metres;
  }

 private:
  MissionStep step_;
};

/// To another depth, or until the time for it is over.
class Dive final : public Manoeuvre {
 public:
  explicit Dive(const MissionStep& step) : step_(step) {}

  void begin(const Situation& /*now*/, Demand& demand) override {
    aim(step_, demand);
    demand.depth_m = *step_.depth_m;
  }

  bool go_on(const Situation& now, Demand& demand) override {
    constexpr double kNear_m = 0.1;
    return std::abs(now.state.depth_m - demand.depth_m) > kNear_m &&
           now.since_s < step_.seconds.value_or(kLongestChangeOfDepth_s);
  }

 private:
  MissionStep step_;
};

/// Rises to the depth at which GPS is received and stays there for the time of the step.
class Surfacing final : public Manoeuvre {
 public:
  explicit Surfacing(const MissionStep& step) : step_(step) {}

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
  MissionStep step_;
  std::optional<double> up_since_s_;
};

}  // namespace

double nearest_heading(double heading_rad, double near_rad) {
  return near_rad + std::remainder(heading_rad - near_rad, 2 * std::numbers::pi);
}

std::unique_ptr<Manoeuvre> make_steady_manoeuvre(const MissionStep& step) {
  switch (step.kind) {
    case config::StepKind::dive: return std::make_unique<Dive>(step);
    case config::StepKind::surface: return std::make_unique<Surfacing>(step);
    default: return std::make_unique<Leg>(step);
  }
}

}  // namespace navcal::autopilot
