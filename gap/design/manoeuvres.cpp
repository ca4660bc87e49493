// SPDX-License-Identifier: Apache-2.0
#include "gap/design/manoeuvres.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/angles.h"

namespace navcal::gap {
namespace {

constexpr double kSurface_m = 0.15;
/// Steady leg before and after a manoeuvre, s.
constexpr double kSettle_s = 6;

class Alphabet {
 public:
  explicit Alphabet(const config::MissionLimits& limits) : limits_(limits) {
    const double least = 60 * limits.least_shaft_rps, greatest = 60 * limits.greatest_shaft_rps;
    speeds_rpm_ = {least + 0.1 * (greatest - least), least + 0.6 * (greatest - least), greatest};
    for (double& rpm : speeds_rpm_) rpm = std::round(rpm);
    shallow_m_ =
        std::max(limits.least_depth_m, std::min(0.8, 0.5 * (limits.least_depth_m + limits.greatest_depth_m)));
    deep_m_ = 0.9 * limits.greatest_depth_m;
  }

  std::vector<ManoeuvreChoice> make() {
    circles();
    rudder();
    doublets();
    depths();
    speeds();
    surface();
    return std::move(all_);
  }

 private:
  void add(std::string name, double seconds, std::vector<std::string> steps) {
    all_.push_back({std::move(name), std::move(steps), seconds});
  }
  static std::string speed_step(double rpm, double seconds) {
    return fmt::format("{{do = \"speed\", shaft_rpm = {:.0f}, seconds = {:.0f}}}", rpm, seconds);
  }
  static std::string leg(double heading_deg, double seconds) {
    return fmt::format("{{do = \"leg\", heading_deg = {:.0f}, seconds = {:.0f}}}", heading_deg, seconds);
  }
  static std::string dive(double depth_m) { return fmt::format("{{do = \"dive\", depth_m = {:.2f}}}", depth_m); }

  void circles() {
    const double most_deg_s = 0.9 * limits_.greatest_turn_rate_rad_s * base::kDegreesPerRadian;
    for (const double rate_deg_s : {10.0, 20.0, 30.0}) {
      if (rate_deg_s > most_deg_s) continue;
      for (const int side : {1, -1}) {
        const char* const word = side > 0 ? "starboard" : "port";
        add(fmt::format("circle to {} at {:.0f} deg/s, {:.1f} m deep", word, rate_deg_s, shallow_m_),
            360 / rate_deg_s + kSettle_s,
            {dive(shallow_m_),
             fmt::format("{{do = \"circle\", turns = {}, rate_deg_s = {:.0f}}}", side, rate_deg_s)});
      }
    }
    if (most_deg_s < 15) return;
    add("circle both ways at 15 deg/s while diving and rising", 60,
        {fmt::format("{{do = \"spiral\", turns = 1, rate_deg_s = 15, depth_m = {:.2f}}}", deep_m_),
         fmt::format("{{do = \"spiral\", turns = -1, rate_deg_s = 15, depth_m = {:.2f}}}", shallow_m_)});
  }

  void rudder() {
    for (const double rudder_deg : {8.0, 15.0}) {
      add(fmt::format("zigzag with {:.0f} degrees of rudder", rudder_deg), 24,
          {dive(shallow_m_),
           fmt::format("{{do = \"zigzag\", rudder_deg = {0:.0f}, reach_deg = 20, times = 4}}", rudder_deg)});
    }
  }

  void doublets() {
    for (const double rpm : {speeds_rpm_[0], speeds_rpm_[1], speeds_rpm_[2]}) {
      for (const double rudder_deg : {3.0, 12.0}) {
        add(fmt::format("rudder doublets of {:.0f} degrees at {:.0f} rpm", rudder_deg, rpm), 24,
            {speed_step(rpm, kSettle_s),
             fmt::format("{{do = \"doublet\", on = \"rudder\", amplitude_deg = {:.0f}, seconds = 2, times = 3}}",
                         rudder_deg)});
      }
      add(fmt::format("elevator doublets at {:.0f} rpm, {:.1f} m deep", rpm, shallow_m_), 24,
          {dive(std::max(shallow_m_, 0.5 * deep_m_)), speed_step(rpm, kSettle_s),
           "{do = \"doublet\", on = \"elevator\", amplitude_deg = 4, seconds = 1.5, times = 3}"});
    }
    add("small rudder reversals", 18,
        {speed_step(speeds_rpm_[1], kSettle_s),
         "{do = \"doublet\", on = \"rudder\", amplitude_deg = 1.5, seconds = 1, times = 6}"});
    for (const int fin : {1, 2, 3}) {
      add(fmt::format("doublets of fin {}", fin), 18,
          {dive(std::max(shallow_m_, 0.5 * deep_m_)),
           fmt::format("{{do = \"doublet\", on = \"fin{}\", amplitude_deg = 3, seconds = 1, times = 3}}", fin)});
    }
  }

  void depths() {
    for (const double rpm : {speeds_rpm_[0], speeds_rpm_[1], speeds_rpm_[2]}) {
      add(fmt::format("dive to {:.1f} m and back at {:.0f} rpm", deep_m_, rpm), 45,
          {speed_step(rpm, kSettle_s), dive(deep_m_), dive(shallow_m_)});
    }
    add(fmt::format("legs at {:.1f} m and at {:.1f} m", shallow_m_, deep_m_), 50,
        {fmt::format("{{do = \"leg\", depth_m = {:.2f}, seconds = 20}}", shallow_m_),
         fmt::format("{{do = \"leg\", depth_m = {:.2f}, seconds = 20}}", deep_m_)});
  }

  void speeds() {
    add("steps of speed on one heading", 36,
        {speed_step(speeds_rpm_[0], 12), speed_step(speeds_rpm_[2], 12), speed_step(speeds_rpm_[1], 12)});
    for (const double heading_deg : {0.0, 90.0}) {
      add(fmt::format("steps of speed, heading {:.0f} and back", heading_deg), 56,
          {leg(heading_deg, 6), speed_step(speeds_rpm_[2], 20), leg(heading_deg + 180, 6),
           speed_step(speeds_rpm_[0], 20)});
    }
  }

  void surface() {
    if (limits_.least_depth_m > kSurface_m) return;
    add("rest at the surface, motor off", 30,
        {"{do = \"surface\", seconds = 10}",
         "{do = \"direct\", rudder_deg = 0, elevator_deg = 0, shaft_rpm = 0, seconds = 18}"});
    for (const double heading_deg : {0.0, 90.0}) {
      add(fmt::format("legs at the surface on {:.0f} and {:.0f} degrees, with fixes", heading_deg,
                      heading_deg + 180),
          60, {"{do = \"surface\", seconds = 8}", leg(heading_deg, 22), leg(heading_deg + 180, 26)});
    }
    add("legs at the surface on three headings, with fixes", 66,
        {"{do = \"surface\", seconds = 6}", leg(0, 18), leg(120, 20), leg(240, 20)});
    add("circle at the surface, with fixes", 28,
        {"{do = \"surface\", seconds = 6}", "{do = \"circle\", turns = 1, rate_deg_s = 18}"});
  }

  const config::MissionLimits& limits_;
  std::array<double, 3> speeds_rpm_{};
  double shallow_m_ = 0, deep_m_ = 0;
  std::vector<ManoeuvreChoice> all_;
};

}  // namespace

std::vector<ManoeuvreChoice> manoeuvre_alphabet(const config::MissionLimits& limits) {
  return Alphabet(limits).make();
}

std::string mission_file_of(const std::vector<const ManoeuvreChoice*>& chosen, const config::MissionLimits& limits,
                            const std::string& title) {
  const double start_m = std::max(limits.least_depth_m, kSurface_m);
  const double rpm =
      std::round(60 * (limits.least_shaft_rps + 0.6 * (limits.greatest_shaft_rps - limits.least_shaft_rps)));
  std::string text = fmt::format(
      "mission.description = \"{}\"\nmission.at_end = \"hold\"\nstart.depth_m = {:.2f}\nstart.shaft_rpm = "
      "{:.0f}\n\n"
      "step = [\n  {{do = \"leg\", heading_deg = 0, seconds = {:.0f}}},\n",
      title, start_m, rpm, kSettle_s);
  bool is_outbound = true;
  for (const ManoeuvreChoice* choice : chosen) {
    text += fmt::format("  # {}\n", choice->name);
    for (const std::string& step : choice->steps) text += fmt::format("  {},\n", step);
    // Each manoeuvre begins from the same speed and a steady course, by turns out and back, so that the vehicle
    // stays in its area.
    is_outbound = !is_outbound;
    text += fmt::format(
        "  {{do = \"speed\", shaft_rpm = {:.0f}, seconds = 1}},\n  {{do = \"leg\", heading_deg = {}, seconds = "
        "{:.0f}}},\n",
        rpm, is_outbound ? 0 : 180, kSettle_s + 2);
  }
  text += "]\n";
  return text;
}

}  // namespace navcal::gap
