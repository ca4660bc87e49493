// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/angles.h"
#include "bench/calibration/magnetometer.h"
#include "bench/calibration/tables.h"
#include "calib/suite/suite.h"
#include "tests/calib/magnetometer_paths.h"

namespace navcal::bench {
namespace {

using namespace calib;
using test::Attitude;
using test::Random;

constexpr double kInterval_s = 0.1, kDegree = std::numbers::pi / 180;
/// A change is told in time when it is told by the readings of so many seconds since its begin.
constexpr double kInTime_s = 3;
/// The same on the clock of the vehicle: the gate looks ahead, and turns are known some readings later.
constexpr double kToldInTime_s = kInTime_s + Gate::kDelay_s + 0.3;

enum class Motion : std::uint8_t { fast, slow, level, rests, never_moved };
constexpr std::array<const char*, 5> kMotions{"turns fast", "turns slowly", "turns level only", "rests",
                                              "has not moved yet"};

struct Magnet {
  double on_s = 0, off_s = 0, ramp_s = 0;
  Eigen::Vector3d size_uT = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d at(double t_s) const {
    const auto part = [&](double begin_s) { return std::clamp((t_s - begin_s) / ramp_s, 0.0, 1.0); };
    return (part(on_s) - part(off_s)) * size_uT;
  }
};

/// Time of the motion: it rests where the vehicle does.
double moved_s(Motion motion, const Magnet& magnet, double t_s) {
  if (motion != Motion::rests && motion != Motion::never_moved) return t_s;
  constexpr double kEase_s = 2, kBefore_s = 5, kAfter_s = 6;
  const auto rest = [&](double from_s, double to_s) {
    // The rest takes what it lasts out of the time of the motion, with a smooth begin and end.
    const auto ramp = [&](double at_s) {
      const double x = std::clamp((t_s - at_s) / kEase_s, 0.0, 1.0);
      return kEase_s * (x * x * x - x * x * x * x / 2) + std::max(0.0, t_s - at_s - kEase_s);
    };
    return ramp(from_s) - ramp(to_s);
  };
  const double begin_s = motion == Motion::rests ? magnet.on_s - kBefore_s : -2 * kEase_s;
  return t_s - rest(begin_s, magnet.on_s + kAfter_s) - rest(magnet.off_s - kBefore_s / 2, magnet.off_s + kAfter_s);
}

Attitude attitude_at(Motion motion, const Magnet& magnet, double t_s) {
  constexpr double kShown_s = 40;
  const double s = moved_s(motion, magnet, t_s);
  const Attitude fast{1.1 * s + std::sin(0.31 * s), 0.8 * std::sin(0.83 * s), 0.7 * std::sin(0.57 * s)};
  if (motion != Motion::slow && motion != Motion::level) return fast;
  const Attitude slow{0.14 * s, 0.1 * std::sin(0.9 * s), 0.08 * std::sin(0.7 * s)};
  const double x = motion == Motion::level ? 1 : std::clamp((s - kShown_s) / 5, 0.0, 1.0),
               part = x * x * (3 - 2 * x);
  const auto between = [&](double a, double b) { return a + part * (b - a); };
  return {between(fast.heading_rad, slow.heading_rad), between(fast.roll_rad, slow.roll_rad),
          between(fast.pitch_rad, slow.pitch_rad)};
}

template <class AttitudeAt>
Eigen::Vector3d rates_at(const AttitudeAt& attitude, double t_s) {
  constexpr double kHalf_s = 0.01;
  const Attitude before = attitude(t_s - kHalf_s), now = attitude(t_s), after = attitude(t_s + kHalf_s);
  const double yaw = (after.heading_rad - before.heading_rad) / (2 * kHalf_s),
               pitch = (after.pitch_rad - before.pitch_rad) / (2 * kHalf_s),
               roll = (after.roll_rad - before.roll_rad) / (2 * kHalf_s);
  return {roll - yaw * std::sin(now.pitch_rad),
          pitch * std::cos(now.roll_rad) + yaw * std::sin(now.roll_rad) * std::cos(now.pitch_rad),
          yaw * std::cos(now.roll_rad) * std::cos(now.pitch_rad) - pitch * std::sin(now.roll_rad)};
}

/// A vehicle with compass and gyro.
class Vehicle {
 public:
  Vehicle(double noise_uT, std::uint64_t seed)
      : suite_(options(), {.compass = true, .rate = true}), random_(seed), noise_uT_(noise_uT) {
    bias_rad_s_ = 0.01 * Eigen::Vector3d(normal(), normal(), normal());
    iron_ = test::some_iron();
    iron_.hard_uT *= std::uniform_real_distribution<double>(0, 1.5)(random_);
  }
  /// One reading. `here_uT`: what the place adds, north, east, down from the heading's origin.
  template <class AttitudeAt>
  void go(double t_s, const AttitudeAt& attitude, const Eigen::Vector3d& magnet_uT,
          const Eigen::Vector3d& here_uT = Eigen::Vector3d::Zero(), double tilt_error_rad = 0) {
    for (const double at_s : {t_s - kInterval_s / 2, t_s}) {
      RateReading rate;
      rate.time_s = at_s;
      rate.rate_rad_s =
          rates_at(attitude, at_s) + bias_rad_s_ + 0.002 * Eigen::Vector3d(normal(), normal(), normal());
      suite_.put(rate);
    }
    const Attitude now = attitude(t_s);
    const Eigen::Vector3d added_uT = Eigen::AngleAxisd(-now.roll_rad, Eigen::Vector3d::UnitX()) *
                                     (Eigen::AngleAxisd(-now.pitch_rad, Eigen::Vector3d::UnitY()) *
                                      (Eigen::AngleAxisd(-now.heading_rad, Eigen::Vector3d::UnitZ()) * here_uT));
    CompassReading reading;
    reading.time_s = t_s;
    reading.roll_rad = now.roll_rad + tilt_error_rad + 0.1 * kDegree * normal();
    reading.pitch_rad = now.pitch_rad + tilt_error_rad + 0.1 * kDegree * normal();
    reading.field_body_uT = iron_.soft * (test::field_in_body(now) + added_uT) + iron_.hard_uT + magnet_uT +
                            noise_uT_ * Eigen::Vector3d(normal(), normal(), normal());
    reading.heading_rad = levelled_heading(*reading.field_body_uT, *reading.roll_rad, *reading.pitch_rad);
    suite_.put(reading);
  }
  [[nodiscard]] Suite& suite() { return suite_; }
  [[nodiscard]] Random& random() { return random_; }
  double normal() { return std::normal_distribution<double>()(random_); }

 private:
  static SuiteOptions options() {
    SuiteOptions options;
    options.tilt_lag_s = 0;
    options.automatic = false;
    return options;
  }
  Suite suite_;
  Random random_;
  double noise_uT_;
  Eigen::Vector3d bias_rad_s_;
  test::Iron iron_;
};

struct Counts {
  int changes = 0, in_time = 0, right = 0, covered = 0, in_the_end = 0, returns = 0, named = 0, others = 0;
  int forced = 0, honest = 0;  ///< a calibration in force: moved rightly, left, or with an error that covers it
  void add(const Counts& more) {
    changes += more.changes, in_time += more.in_time, right += more.right, covered += more.covered;
    in_the_end += more.in_the_end, returns += more.returns, named += more.named, others += more.others;
    forced += more.forced, honest += more.honest;
  }
};

bool is_right(const Eigen::Vector3d& found_uT, const Eigen::Vector3d& true_uT) {
  return (found_uT - true_uT).norm() < 0.15 * true_uT.norm() + 1;
}

Counts run(Motion motion, double size_uT, double noise_uT, std::uint64_t seed) {
  Vehicle vehicle(noise_uT, seed);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(vehicle.random());
  };
  Magnet magnet;
  magnet.on_s = motion == Motion::never_moved ? between(20, 30) : between(60, 70);
  magnet.off_s = magnet.on_s + between(10, 60);
  magnet.ramp_s = between(0.2, 2);
  magnet.size_uT = size_uT * Eigen::Vector3d(vehicle.normal(), vehicle.normal(), vehicle.normal()).normalized();
  const double end_s = magnet.off_s + 30;
  const auto attitude = [&](double t_s) { return attitude_at(motion, magnet, t_s); };
  Counts counts;
  std::array<bool, 2> told{};
  std::optional<Eigen::Vector3d> offset_uT;
  Suite& suite = vehicle.suite();
  const auto check_force = [&](const Eigen::Vector3d& by_uT) {
    if (!offset_uT) return;
    ++counts.forced;
    const auto& now = suite.in_force().correction().magnetometer;
    if (now) {
      const Eigen::Vector3d error_uT = now->offset_uT - *offset_uT - by_uT;
      const double std_uT = suite.report().find(Calibrator::magnetometer)->step_std_uT.norm();
      if (error_uT.norm() > std::max(0.15 * size_uT + 1, 2.5 * std_uT)) return;
    }
    ++counts.honest;
  };
  bool accepted = false;
  for (double t_s = kInterval_s; t_s < end_s; t_s += kInterval_s) {
    vehicle.go(t_s, attitude, magnet.at(t_s));
    if (!accepted && t_s > 50) {
      accepted = true;
      if (motion != Motion::never_moved && suite.accept(Calibrator::magnetometer, true).empty())
        offset_uT = suite.in_force().correction().magnetometer->offset_uT;
    }
    for (int i = 0; i < 2; ++i) {
      const double begin_s = i == 0 ? magnet.on_s : magnet.off_s;
      const Eigen::Vector3d& all_uT = magnet.size_uT;
      if (std::abs(t_s - begin_s - kToldInTime_s) < kInterval_s / 2)
        check_force(i == 0 ? all_uT : Eigen::Vector3d(Eigen::Vector3d::Zero()));
    }
    if (const auto step = suite.take_field_step()) {
      bool matched = false;
      for (std::size_t i = 0; i < 2; ++i) {
        const double begin_s = i == 0 ? magnet.on_s : magnet.off_s;
        if (told[i] || step->time_s < begin_s - 1 || step->time_s > begin_s + kInTime_s) continue;
        told[i] = matched = true;
        if (t_s > begin_s + kToldInTime_s + kInterval_s / 2) break;
        ++counts.in_time;
        const Eigen::Vector3d true_uT = (i == 0 ? 1 : -1) * magnet.size_uT;
        counts.right += is_right(step->size_uT, true_uT);
        counts.covered += ((step->size_uT - true_uT).array().abs() < 3 * step->std_uT.array() + 0.3).all();
        counts.named += i == 1 && step->returned;
        break;
      }
      counts.others += !matched;
    }
  }
  suite.finish();
  counts.changes = 2;
  counts.returns = 1;
  for (int i = 0; i < 2; ++i) {
    const double begin_s = i == 0 ? magnet.on_s : magnet.off_s;
    for (const FieldStep& step : suite.report().steps) {
      if (step.time_s < begin_s - 1 || step.time_s > begin_s + kInTime_s) continue;
      counts.in_the_end += is_right(step.size_uT, (i == 0 ? 1 : -1) * magnet.size_uT);
      break;
    }
  }
  return counts;
}

void print_row(const std::string& name, const Counts& c) {
  fmt::print("| {} | {} | {} | {} | {} | {} | {} of {} | {} of {} | {} |\n", name, c.changes, c.in_time, c.right,
             c.covered, c.in_the_end, c.named, c.returns, c.honest, c.forced, c.others);
}

/// Steps told in a walk past iron; `turns`: the track meanders at up to 8 degrees/s.
int walk(double duration_s, double noise_uT, bool turns_slowly, std::uint64_t seed) {
  constexpr double kSpeed_m_s = 1.3, kShown_s = 40;
  Vehicle vehicle(noise_uT, seed);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(vehicle.random());
  };
  struct Turn {
    double at_s, by_rad;
  };
  std::vector<Turn> turns;
  for (double t_s = kShown_s; !turns_slowly && t_s < duration_s; t_s += between(10, 40))
    turns.push_back({t_s, between(-2, 2)});
  const auto heading = [&](double t_s) {
    double sum = turns_slowly ? 1.4 * std::sin(0.1 * t_s) : 0;
    for (const Turn& turn : turns) {
      const double x = std::clamp((t_s - turn.at_s) / 2, 0.0, 1.0);
      sum += turn.by_rad * x * x * (3 - 2 * x);
    }
    return sum;
  };
  const auto attitude = [&](double t_s) {
    const double x = std::clamp((t_s - kShown_s) / 3, 0.0, 1.0), part = x * x * (3 - 2 * x), shown = 1 - part;
    return Attitude{shown * (1.1 * t_s + std::sin(0.31 * t_s)) + heading(t_s) + 0.1 * part * std::sin(6.3 * t_s),
                    shown * 0.8 * std::sin(0.83 * t_s) + 0.05 * part * std::sin(6.3 * t_s + 1),
                    shown * 0.7 * std::sin(0.57 * t_s) + 0.04 * part * std::sin(12.6 * t_s)};
  };
  // Iron beside the track: dipoles with what they add at their nearest.
  struct Iron {
    Eigen::Vector3d at_m, moment_uT_m3;
  };
  std::vector<Iron> iron;
  std::vector<Eigen::Vector3d> track;
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();
  double next_s = kShown_s + 20;
  for (double t_s = 0; t_s < duration_s; t_s += kInterval_s) {
    if (t_s > kShown_s)
      at_m += kSpeed_m_s * kInterval_s * Eigen::Vector3d(std::cos(heading(t_s)), std::sin(heading(t_s)), 0);
    track.push_back(at_m);
    if (t_s < next_s) continue;
    next_s = t_s + between(4, 20);
    const double distance_m = between(0.6, 5), peak_uT = between(5, 40), side = between(-1, 1) < 0 ? -1 : 1;
    const Eigen::Vector3d away(-side * std::sin(heading(t_s)), side * std::cos(heading(t_s)), between(-0.5, 1));
    iron.push_back({at_m + distance_m * away.normalized(),
                    peak_uT / 1.5 * std::pow(distance_m, 3) *
                        Eigen::Vector3d(vehicle.normal(), vehicle.normal(), vehicle.normal()).normalized()});
  }
  int told = 0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    Eigen::Vector3d here_uT = Eigen::Vector3d::Zero();
    for (const Iron& one : iron) {
      const Eigen::Vector3d r = track[i] - one.at_m;
      const double r_m = std::max(0.5, r.norm());
      if (r_m > 40) continue;
      here_uT += (3 * one.moment_uT_m3.dot(r) / (r_m * r_m) * r - one.moment_uT_m3) / std::pow(r_m, 3);
    }
    const double t_s = kInterval_s * static_cast<double>(i);
    vehicle.go(t_s, attitude, Eigen::Vector3d::Zero(), here_uT,
               t_s > kShown_s ? 0.012 * std::sin(12.6 * t_s + 0.5) : 0);
    told += vehicle.suite().take_field_step().has_value();
  }
  return told;
}

}  // namespace

void print_steps(const TableOptions& options) {
  const int seeds = std::max(1, options.runs / 500);
  fmt::print(
      "A magnet comes within 0.2 to 2 s, and goes 10 to 60 s later; field noise of 0.1, 0.3 and 1 uT, {} seeds "
      "each. "
      "In\ntime: told by the readings of {} s since the change began, then with a size within 15 % and 1 uT, or "
      "within "
      "three\nstandard errors. In the end: the size after the recording. In force: a calibration in force has "
      "then "
      "moved\nrightly, has left force, or states an error that covers it.\n\n"
      "| vehicle | changes | in time | size right | size covered | right in the end | returns named | in force | "
      "others told |\n|-|-|-|-|-|-|-|-|-|\n",
      seeds, kInTime_s);
  constexpr std::array kSizes_uT{3.0, 6.0, 14.0, 27.0, 58.0};
  constexpr std::array kNoises_uT{0.1, 0.3, 1.0};
  std::array<Counts, kSizes_uT.size()> by_size;
  std::array<Counts, kNoises_uT.size()> by_noise;
  Counts all;
  std::uint64_t seed = options.seed;
  for (std::size_t m = 0; m < kMotions.size(); ++m) {
    Counts sum;
    for (std::size_t s = 0; s < kSizes_uT.size(); ++s) {
      for (std::size_t n = 0; n < kNoises_uT.size(); ++n) {
        for (int i = 0; i < seeds; ++i) {
          const Counts one = run(static_cast<Motion>(m), kSizes_uT[s], kNoises_uT[n], seed++);
          by_size[s].add(one);
          if (s > 0) {
            sum.add(one);
            by_noise[n].add(one);
            all.add(one);
          }
        }
      }
    }
    print_row(kMotions[m], sum);
  }
  for (std::size_t n = 0; n < kNoises_uT.size(); ++n)
    print_row(fmt::format("noise {} uT", kNoises_uT[n]), by_noise[n]);
  for (std::size_t s = 0; s < kSizes_uT.size(); ++s) print_row(fmt::format("{} uT", kSizes_uT[s]), by_size[s]);
  print_row("all of 6 uT and more", all);
  constexpr double kWalk_s = 1200;
  fmt::print(
      "\nA walk of 20 minutes past iron of 5 to 40 uT, every 5 to 26 m; none of the steps told is right.\n");
  for (const bool turns_slowly : {false, true}) {
    fmt::print("{}:", turns_slowly ? "Turning at up to 8 degrees/s all the time" : "Straight, with turns");
    for (const double noise_uT : kNoises_uT)
      fmt::print(" {} told with {} uT;", walk(kWalk_s, noise_uT, turns_slowly, seed++), noise_uT);
    fmt::print("\n");
  }
}

}  // namespace navcal::bench
