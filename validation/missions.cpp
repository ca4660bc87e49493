// SPDX-License-Identifier: Apache-2.0
#include "validation/missions.h"

#include <cmath>
#include <utility>

#include "base/angles.h"
#include "base/world_magnetic_model.h"
#include "validation/reference/instrument.h"
#include "validation/reference/rng.h"

namespace navcal::validation {

TrialPlace drawn_place(std::uint64_t seed, int number) {
  constexpr double kGreatestLatitude_deg = 80;
  /// Apart from the cases and their orders of drawing.
  constexpr std::uint64_t kPlaceStream = 1ULL << 40U;
  constexpr double kFrom_days = 20'089, kUntil_days = 21'910;  // 2025-01-01, 2029-12-27
  reference::Rng dice(seed, kPlaceStream + static_cast<std::uint64_t>(number));
  TrialPlace place;
  const double sine = std::sin(kGreatestLatitude_deg / base::kDegreesPerRadian);
  place.anchorage = {std::asin(dice.uniform(-sine, sine)) * base::kDegreesPerRadian, dice.uniform(-180, 180), 0};
  const auto day = static_cast<std::int64_t>(dice.uniform(kFrom_days, kUntil_days));
  place.begin_ns = day * kDay_ns + kTrialBegin_ns % kDay_ns;
  place.waters.surface_C = dice.uniform(2, 28);
  place.waters.density_kg_m3 = dice.uniform(998, 1028);
  place.waters.field_uT = base::world_magnetic_field(
                              {place.anchorage.latitude_deg / base::kDegreesPerRadian,
                               place.anchorage.longitude_deg / base::kDegreesPerRadian, place.anchorage.height_m},
                              base::decimal_year(place.begin_ns))
                              .north_east_down_uT;
  return place;
}

reference::Mission at_place(reference::Mission mission, const TrialPlace& place) {
  mission.anchorage = place.anchorage;
  mission.waters = place.waters;
  mission.start_ns += place.begin_ns - kTrialBegin_ns;
  return mission;
}

namespace {

using reference::kDegree;

/// The other missions begin a day later each.
constexpr double kSurface_m = 0.15;  ///< the antenna needs 0.35

/// Orders one after the other, each for some seconds; what a line leaves out stays as it was.
class Script {
 public:
  explicit Script(double heading_deg, double still_s) : now_s_(still_s) {
    mission_.start.position_m = {0, 0, kSurface_m};
    mission_.start.world_from_body = reference::attitude(0, 0, heading_deg * kDegree);
    order_.depth_m = kSurface_m;
    order_.heading_rad = heading_deg * kDegree;
    order_.speed_m_s = 1.0;
  }

  Script& speed(double m_s) { return order_.speed_m_s = m_s, *this; }
  Script& depth(double m) { return order_.depth_m = m, *this; }
  Script& leg(double heading_deg, double seconds) {
    order_.heading_rad = heading_deg * kDegree;
    return for_s(seconds);
  }
  /// On as before.
  Script& on(double seconds) { return for_s(seconds); }
  /// Holds the rudder; ends on any heading.
  Script& circle(double rudder_deg, double seconds) {
    reference::Order order = order_;
    order.heading_rad.reset();
    order.rudder_rad = rudder_deg * kDegree;
    return for_s(seconds, order);
  }
  /// Rudder to one side and to the other; then the heading is held again.
  Script& rudder_doublet(double deg, double seconds) { return circle(deg, seconds).circle(-deg, seconds); }
  Script& elevator_doublet(double deg, double seconds) { return elevator(deg, seconds).elevator(-deg, seconds); }
  /// Dives and rises, so that the vehicle pitches both ways.
  Script& porpoise(double upper_m, double lower_m, double seconds) {
    return depth(lower_m).on(seconds).depth(upper_m).on(seconds);
  }

  [[nodiscard]] reference::Mission finish(double duration_s, int day) {
    mission_.start_ns = kTrialBegin_ns + day * kDay_ns;
    mission_.duration_s = duration_s;
    return std::move(mission_);
  }
  [[nodiscard]] double now_s() const { return now_s_; }

 private:
  Script& elevator(double deg, double seconds) {
    reference::Order order = order_;
    order.depth_m.reset();
    order.elevator_rad = deg * kDegree;
    return for_s(seconds, order);
  }
  Script& for_s(double seconds) { return for_s(seconds, order_); }
  Script& for_s(double seconds, reference::Order order) {
    order.from_s = now_s_;
    mission_.orders.push_back(order);
    now_s_ += seconds;
    return *this;
  }

  reference::Mission mission_;
  reference::Order order_;
  double now_s_;
};

reference::Mission usual_a() {
  Script s(0, 6);
  s.leg(0, 42).leg(180, 44);                                   // reciprocal, at the surface
  s.leg(90, 15).speed(1.4).on(12);                             // a third heading; a step of the motor current
  s.depth(3).on(16).circle(10, 40).speed(0.9).circle(10, 30);  // one rate at two speeds
  s.speed(1.3).circle(-5, 45).leg(200, 10).rudder_doublet(4, 2).on(4).rudder_doublet(10, 2).on(6);
  s.depth(kSurface_m).on(14).on(22);                                                      // fixes
  s.depth(5).on(16).depth(1).circle(-12, 22).depth(4.5).circle(-12, 22).depth(1).on(16);  // turns while it pitches
  s.leg(20, 12).elevator_doublet(5, 2).on(6).speed(1.6).on(10).speed(0.7).on(12).speed(1.2);
  s.depth(kSurface_m).leg(20, 26).leg(200, 38).leg(290, 24);
  s.depth(2).circle(15, 30).leg(110, 14).depth(kSurface_m).leg(110, 60);
  return s.finish(600, 0);
}

reference::Mission usual_b() {
  Script s(240, 3);
  s.speed(1.2).leg(240, 40).leg(60, 42).leg(330, 26);
  s.depth(4).on(20).circle(-8, 50).speed(1.5).circle(-8, 25).speed(1.0).circle(13, 36);
  s.leg(150, 12).rudder_doublet(8, 1.5).on(5).rudder_doublet(3, 3).on(5).porpoise(2, 4, 10);
  s.depth(kSurface_m).leg(150, 40);
  s.depth(1.5).speed(1.4).on(14).speed(0.8).on(14).speed(1.6).on(12).circle(6, 40).depth(5).circle(6, 20);
  s.speed(1.1).circle(-15, 26).leg(45, 12).elevator_doublet(6, 1.5).on(6);
  s.depth(kSurface_m).leg(45, 34).leg(225, 36).leg(135, 60);
  return s.finish(600, 1);
}

reference::Mission usual_c() {
  Script s(120, 10);
  s.leg(120, 36).speed(1.3).leg(300, 40).leg(30, 26);
  s.depth(2).on(14).circle(14, 34).depth(3.5).circle(-14, 34).speed(0.9).leg(260, 12).rudder_doublet(6, 2.5).on(6);
  s.speed(1.5).on(10).rudder_doublet(6, 2.5).on(6).porpoise(1.5, 4.5, 14);
  s.depth(kSurface_m).leg(80, 42);
  s.depth(3.5).circle(-6, 55).depth(1).circle(9, 30).elevator_doublet(4, 2.5).speed(0.8).on(14).speed(1.4).on(12);
  s.depth(kSurface_m).leg(210, 36).leg(30, 38).depth(3).leg(120, 16).circle(7, 36).depth(kSurface_m).leg(300, 60);
  return s.finish(600, 2);
}

reference::Mission brief_a() {
  Script s(0, 3);
  s.speed(1.2).leg(0, 22).leg(180, 24).depth(2.5).circle(11, 26).speed(1.5).circle(-7, 24);
  s.leg(90, 6).rudder_doublet(6, 2).porpoise(1, 3, 9).speed(0.9).on(6).depth(kSurface_m).leg(270, 40);
  return s.finish(180, 0);
}

reference::Mission brief_b() {
  Script s(220, 3);
  s.leg(220, 24).speed(1.4).leg(40, 22).depth(3).circle(-12, 26).speed(1.0).circle(6, 26);
  s.elevator_doublet(5, 2).leg(310, 8).speed(1.5).on(8).porpoise(1.5, 3, 8).depth(kSurface_m).leg(130, 40);
  return s.finish(180, 1);
}

reference::Mission brief_c() {
  Script s(100, 3);
  s.speed(1.3).leg(100, 22).leg(280, 22).depth(2).circle(8, 30).circle(-14, 22).speed(0.9).on(6);
  s.rudder_doublet(8, 1.5).leg(10, 8).speed(1.4).porpoise(1, 3.5, 10).depth(kSurface_m).leg(190, 40);
  return s.finish(180, 2);
}

/// One heading and one speed throughout; the middle third below.
reference::Mission straight(double heading_deg, double speed_m_s, double depth_m, double duration_s, int day) {
  Script s(heading_deg, 3);
  s.speed(speed_m_s).on(duration_s / 3).depth(depth_m).on(duration_s / 3).depth(kSurface_m).on(duration_s / 3);
  return s.finish(duration_s, day);
}

}  // namespace

std::array<reference::Mission, 3> trial_missions(MissionKind kind, int minutes) {
  if (kind == MissionKind::poor) {
    const double duration_s = 60.0 * minutes;
    return {straight(40, 1.2, 1, duration_s, 0), straight(160, 1.2, 1, duration_s, 1),
            straight(280, 1.2, 1, duration_s, 2)};
  }
  if (kind == MissionKind::brief || minutes <= kBriefMinutes) return {brief_a(), brief_b(), brief_c()};
  return {usual_a(), usual_b(), usual_c()};
}

}  // namespace navcal::validation
