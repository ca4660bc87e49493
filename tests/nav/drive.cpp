// SPDX-License-Identifier: Apache-2.0
#include "tests/nav/drive.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/angles.h"
#include "base/rotation.h"

namespace navcal::nav::test {
namespace {

/// Timing of one instrument.
struct Timing {
  std::int64_t period_ns;
  std::int64_t latency_ns;
};
constexpr Timing kRates{50'000'000, 31'000'000}, kCompass{100'000'000, 66'000'000},
    kShaft{100'000'000, 20'000'000}, kFixes{1'000'000'000, 460'000'000};

class Normal {
 public:
  Normal(std::uint32_t seed, bool on) : random_(seed), on_(on) {}
  double operator()(double std) {
    const double value = normal_(random_);
    return on_ ? std * value : 0;
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  bool on_;
};

template <class Make>
void sample(std::vector<Arrived>& out, double duration_s, Timing timing, bool late, Make make) {
  const std::int64_t end_ns = kStart_ns + std::llround(duration_s * 1e9);
  for (std::int64_t t_ns = kStart_ns; t_ns <= end_ns; t_ns += timing.period_ns)
    make(t_ns, [&](const Reading& reading) { out.push_back({t_ns + (late ? timing.latency_ns : 0), reading}); });
}

/// Velocity of the place of the instrument: over the bottom, or through the water.
Eigen::Vector3d velocity_there_m_s(const sim::State& state, const DvlOptions& dvl,
                                   const Eigen::Vector2d& current_m_s) {
  const Eigen::Matrix3d world_from_body =
      base::rotation_of({state.euler_rad[0], state.euler_rad[1], state.euler_rad[2]});
  const Eigen::Vector3d rate_rad_s(state.rate_rad_s.data());
  const Eigen::Vector3d body_m_s =
      Eigen::Vector3d(state.velocity_body_m_s.data()) +
      world_from_body.transpose() * Eigen::Vector3d(current_m_s.x(), current_m_s.y(), 0) +
      rate_rad_s.cross(dvl.position_m);
  if (dvl.frame == VelocityFrame::earth) return world_from_body * body_m_s;
  return base::rotation_of({0, 0, dvl.yaw_rad}).transpose() * body_m_s;
}

void sample_dvl(std::vector<Arrived>& out, double duration_s, const sim::Motion& motion,
                const DriveOptions& options) {
  const DvlOptions& dvl = *options.dvl;
  Normal noise(options.seed + 1000, options.noise);
  std::mt19937 random(options.seed + 2000);
  const Timing timing{std::llround(dvl.period_s * 1e9), std::llround(dvl.latency_s * 1e9)};
  sample(out, duration_s, timing, options.late, [&](std::int64_t t_ns, auto put) {
    const auto state = motion.at(t_ns);
    const auto measured_m_s = [&](const Eigen::Vector2d& current_m_s) -> Eigen::Vector3d {
      Eigen::Vector3d measured = dvl.scale * velocity_there_m_s(state, dvl, current_m_s);
      for (double& axis : measured) axis += noise(dvl.noise_m_s);
      if (std::uniform_real_distribution<double>()(random) < dvl.bad_share) measured.x() -= 3;
      return measured;
    };
    if (dvl.water) put(WaterVelocityReading{t_ns, measured_m_s({0, 0}), dvl.frame, dvl.noise_m_s, dvl.position_m});
    if (dvl.bottom && dvl.locked(since_start_s(t_ns)))
      put(GroundVelocityReading{t_ns, measured_m_s(options.current_m_s), dvl.frame, dvl.noise_m_s,
                                dvl.position_m});
  });
}

}  // namespace

std::vector<Arrived> readings_along(const sim::Motion& motion, double duration_s, const DriveOptions& options) {
  std::vector<Arrived> out;
  Normal noise(options.seed, options.noise);
  if (options.rates) {
    sample(out, duration_s, kRates, options.late, [&](std::int64_t t_ns, auto put) {
      const auto state = motion.at(t_ns);
      RateReading reading{t_ns, Eigen::Vector3d(state.rate_rad_s.data()) + options.zero_rad_s,
                          state.position_m[2]};
      for (double& rate : reading.rate_rad_s) rate += noise(0.1 * kDegree);
      *reading.depth_m += noise(0.02);
      put(reading);
    });
  }
  if (options.compass) {
    sample(out, duration_s, kCompass, options.late, [&](std::int64_t t_ns, auto put) {
      const auto state = motion.at(t_ns);
      // The fluid's lag, as a delay.
      const auto felt = motion.at(t_ns - 300'000'000);
      CompassReading reading{t_ns, {}, {}, {}, false};
      reading.heading_rad = base::as_heading(options.compass_says(state.euler_rad[2]) + noise(0.5 * kDegree));
      reading.pitch_rad = felt.euler_rad[1] + noise(0.1 * kDegree);
      reading.roll_rad = felt.euler_rad[0] + noise(0.1 * kDegree);
      put(reading);
    });
  }
  if (options.shaft) {
    sample(out, duration_s, kShaft, options.late, [&](std::int64_t t_ns, auto put) {
      put(ShaftReading{t_ns, motion.at(t_ns).rpm / 60 * options.shaft_share});
    });
  }
  sample(out, duration_s, kFixes, options.late, [&](std::int64_t t_ns, auto put) {
    if (!options.fixed(since_start_s(t_ns))) return;
    Eigen::Vector2d position_m = true_position_m(motion, t_ns, options.current_m_s);
    for (double& axis : position_m) axis += noise(1);
    Eigen::Vector2d velocity_m_s = true_position_m(motion, t_ns + kSecond_ns / 20, options.current_m_s) -
                                   true_position_m(motion, t_ns - kSecond_ns / 20, options.current_m_s);
    velocity_m_s *= 10;
    for (double& axis : velocity_m_s) axis += noise(0.1);
    put(FixReading{t_ns, position_m, 1, velocity_m_s, 0.1});
  });
  if (options.dvl) sample_dvl(out, duration_s, motion, options);
  std::stable_sort(out.begin(), out.end(),
                   [](const Arrived& a, const Arrived& b) { return a.arrival_ns < b.arrival_ns; });
  return out;
}

void give(Navigator& navigator, const Reading& reading) {
  std::visit([&](const auto& r) { navigator.take(r); }, reading);
}

void give(Navigator& navigator, const std::vector<Arrived>& readings, double until_s) {
  for (const Arrived& arrived : readings) {
    if (since_start_s(arrived.arrival_ns) > until_s) return;
    give(navigator, arrived.reading);
  }
}

Eigen::Vector2d true_position_m(const sim::Motion& motion, std::int64_t time_ns,
                                const Eigen::Vector2d& current_m_s) {
  const auto state = motion.at(time_ns);
  return Eigen::Vector2d(state.position_m[0], state.position_m[1]) + since_start_s(time_ns) * current_m_s;
}

double position_error_m(const Navigator& navigator, const sim::Motion& motion,
                        const Eigen::Vector2d& current_m_s) {
  const auto estimate = navigator.estimate();
  return (estimate.position_m.value() - true_position_m(motion, estimate.time_ns, current_m_s)).norm();
}

double heading_error_rad(const Navigator& navigator, const sim::Motion& motion) {
  const auto estimate = navigator.estimate();
  return base::wrapped(estimate.heading_rad.value() - motion.at(estimate.time_ns).euler_rad[2]);
}

sim::PathMotion level_way(double duration_s, double speed_m_s, const std::function<double(double)>& rate_rad_s,
                          double depth_m, double heading_rad) {
  constexpr double kStep_s = 0.1;
  constexpr int kFine = 10;
  std::vector<sim::PathRow> rows;
  sim::PathRow row;
  row.euler_rad[2] = heading_rad;
  row.position_m[2] = depth_m;
  row.velocity_body_m_s = {speed_m_s, 0, 0};
  row.rpm = speed_m_s / 0.0872 * 60;
  for (int i = 0; i * kStep_s <= duration_s + kStep_s; ++i) {
    row.t_s = i * kStep_s;
    const double now = rate_rad_s(row.t_s), next = rate_rad_s(row.t_s + kStep_s);
    row.rate_rad_s = {0, 0, now};
    rows.push_back(row);
    for (int k = 0; k < kFine; ++k) {
      const double heading = row.euler_rad[2] + ((now + (next - now) * (k + 0.5) / kFine)) * kStep_s / kFine / 2;
      row.euler_rad[2] += (now + (next - now) * (k + 0.5) / kFine) * kStep_s / kFine;
      row.position_m[0] += speed_m_s * std::cos(heading) * kStep_s / kFine;
      row.position_m[1] += speed_m_s * std::sin(heading) * kStep_s / kFine;
    }
  }
  return {std::move(rows), kStart_ns};
}

sim::PathMotion reference_way(const std::string& name) {
  return {sim::load_path(NAVCAL_SOURCE_DIR "/fixtures/paths/" + name + ".csv"), kStart_ns};
}

}  // namespace navcal::nav::test
