// SPDX-License-Identifier: Apache-2.0
// Reports of the whole suite along eventful drives, as they were when this was written (fixtures/calib): a change
// of an estimate, a judgement or a word shows here, whether it was meant or not. Whether they are right is for
// other tests.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <numbers>

#include "base/angles.h"
#include "base/rotation.h"
#include "tests/calib/suite/suite_drive.h"
#include "tests/support/golden.h"

namespace navcal::calib {
namespace {

using namespace test;

constexpr double kDriveStep_s = 0.1;

/// A vehicle with all instruments, ten readings a second, in a sea that sets to the north-east.
class Drive {
 public:
  explicit Drive(const SuiteOptions& options) : options_(options), suite_(options, kEveryInstrument) {}

  /// Goes on for so long, turning at a rate that swings about `turn_rad_s`, with roll and pitch of `tilt_rad`.
  void go(double seconds, double turn_rad_s, double tilt_rad, double rpm = 600, double swing = 0.3) {
    for (const double end_s = time_s_ + seconds; time_s_ < end_s; time_s_ += kDriveStep_s) {
      const double roll_rad = tilt_rad * std::sin(0.9 * time_s_),
                   pitch_rad = tilt_rad * std::sin(0.7 * time_s_ + 1);
      const double rate_rad_s = turn_rad_s * (1 + swing * std::sin(0.2 * time_s_));
      motor(rpm + 150 * std::sin(0.31 * time_s_));
      rates(roll_rad, pitch_rad, rate_rad_s, tilt_rad);
      compass(roll_rad, pitch_rad);
      if (tick_ % 10 == 0) fix();
      if (has_reference && tick_ % 10 == 5) reference();
      heading_rad_ += rate_rad_s * kDriveStep_s;
      position_m_ +=
          kDriveStep_s * (speed_m_s() * Eigen::Vector2d(std::cos(heading_rad_), std::sin(heading_rad_)) + kSet);
      ++tick_;
      while (const auto adopted = suite_.take_adopted())
        lines.add("{:.1f} s: {} in force", time_s_, name_of(*adopted));
      if (const auto step = suite_.take_field_step()) lines.add("{:.1f} s: {}", time_s_, words_of(*step));
    }
  }
  /// The suite is another one that was given the saved state.
  void restart() { suite_ = restored(saved(suite_), options_, kEveryInstrument); }
  void tell(std::string_view after);
  Suite& suite() { return suite_; }

  bool has_reference = true;
  Eigen::Vector3d magnet_uT = Eigen::Vector3d::Zero();
  navcal::test::GoldenLines lines;

 private:
  inline static const Eigen::Vector2d kSet{0.06, 0.03};
  static constexpr double kDeclination_rad = 0.05;

  [[nodiscard]] double speed_m_s() const { return rpm_ / 60 * options_.advance_m; }
  double noise(double std) { return std * normal_(random_); }
  /// Compilers evaluate arguments in their own orders.
  template <int size>
  Eigen::Matrix<double, size, 1> noises(double std) {
    Eigen::Matrix<double, size, 1> all;
    for (double& each : all) each = noise(std);
    return all;
  }

  void motor(double rpm) {
    rpm_ = rpm;
    current_A_ = 4 * rpm / 600;
    suite_.put(MotorReading{time_s_, rpm, current_A_});
  }
  void rates(double roll_rad, double pitch_rad, double rate_rad_s, double tilt_rad) {
    const double roll_rate = tilt_rad * 0.9 * std::cos(0.9 * time_s_),
                 pitch_rate = tilt_rad * 0.7 * std::cos(0.7 * time_s_ + 1);
    const Eigen::Vector3d rate(
        roll_rate - rate_rad_s * std::sin(pitch_rad),
        pitch_rate * std::cos(roll_rad) + rate_rad_s * std::sin(roll_rad) * std::cos(pitch_rad),
        rate_rad_s * std::cos(roll_rad) * std::cos(pitch_rad) - pitch_rate * std::sin(roll_rad));
    RateReading reading;
    reading.time_s = time_s_;
    reading.rate_rad_s = rate + noises<3>(0.002);
    reading.rate_rad_s.z() = (reading.rate_rad_s.z() - 0.01) / 1.04;
    reading.yaw_rate_b_rad_s = (rate.z() - kGyroB.bias_rad_s) / kGyroB.scale + noise(0.002);
    reading.specific_force_m_s2 =
        9.81 * base::rotation_of({roll_rad, pitch_rad, heading_rad_}).transpose() * Eigen::Vector3d(0, 0, -1);
    suite_.put(reading);
  }
  void compass(double roll_rad, double pitch_rad) {
    const Eigen::Vector3d earth_uT(19, 0, 44), hard_uT(3, -2, 1), per_A_uT(0.3, -0.2, 0.1);
    Eigen::Matrix3d soft = Eigen::Matrix3d::Identity();
    soft(0, 0) = 1.05;
    soft(0, 1) = soft(1, 0) = 0.02;
    const double magnetic_rad = heading_rad_ - kDeclination_rad;
    CompassReading reading;
    reading.time_s = time_s_;
    reading.utc_ns = 1'700'000'000'000'000'000 + static_cast<std::int64_t>(time_s_ * 1e9);
    reading.roll_rad = roll_rad + noise(0.002);
    reading.pitch_rad = pitch_rad + noise(0.002);
    reading.field_body_uT =
        soft * (base::rotation_of({roll_rad, pitch_rad, magnetic_rad}).transpose() * earth_uT) + hard_uT +
        magnet_uT + current_A_ * per_A_uT + noises<3>(0.1);
    const Eigen::Vector3d level = base::rotation_of({roll_rad, pitch_rad, 0}) * *reading.field_body_uT;
    reading.heading_rad = base::wrapped(std::atan2(-level.y(), level.x()));
    suite_.put(reading);
    newest_ = reading;
  }
  void fix() {
    const Eigen::Vector2d ground =
        speed_m_s() * Eigen::Vector2d(std::cos(heading_rad_), std::sin(heading_rad_)) + kSet + noises<2>(0.05);
    suite_.put(
        GroundReading{time_s_, position_m_ + noises<2>(1.5), ground.norm(), std::atan2(ground.y(), ground.x())});
  }
  void reference() {
    suite_.put(ReferenceReading{time_s_, 0.005, base::wrapped(heading_rad_ + noise(0.01)), 0.01});
  }

  SuiteOptions options_;
  Suite suite_;
  Random random_{7};
  std::normal_distribution<double> normal_;
  double time_s_ = 0, heading_rad_ = 0.3, rpm_ = 0, current_A_ = 0;
  Eigen::Vector2d position_m_ = Eigen::Vector2d::Zero();
  std::uint64_t tick_ = 0;
  CompassReading newest_;
};

void Drive::tell(std::string_view after) {
  const Report report = suite_.report();
  lines.add("{} ({:.0f} s)", after, time_s_);
  lines.add("in force {}", report.name.number);
  for (const Calibrator calibrator : calibrators()) {
    for (const NamedNumbers& each : values_of(report.in_force, calibrator))
      lines.add("  {} {} {:.3g}", name_of(calibrator), each.name, fmt::join(each.values, " "));
  }
  lines.add("heading {:.4f}", corrected_heading(report.in_force, newest_).value_or(-9));
  for (const CalibratorReport& one : report.calibrators) {
    const Judgement& judgement = one.judgement;
    lines.add("{}: {}, {}, {} samples, coverage {:.2f}, condition {:.3g}{}, {} steps back",
              name_of(one.calibrator), name_of(one.verdict), name_of(one.outcome), judgement.samples,
              judgement.coverage, judgement.condition, one.held ? ", held" : "", one.steps_back);
    if (!judgement.reason.empty()) lines.add("  {}; {}", judgement.reason, judgement.manoeuvre);
    if (judgement.held_out_quantity != HeldOutQuantity::none)
      lines.add("  held out {}: {:.4g} to {:.4g}", static_cast<int>(judgement.held_out_quantity),
                judgement.held_out_before, judgement.held_out_after);
    for (const Quantity& each : one.estimate) lines.add("  {} {:.4g} +- {:.3g}", each.name, each.value, each.std);
    if (one.covariance.size() > 0) lines.add("  covariance {:.3g}", one.covariance.trace());
    if (!one.step_std_uT.isZero()) lines.add("  steps {:.3g}", one.step_std_uT.norm());
  }
  lines.add("headings: {} blocks, {:.4g} {:.4g} {:.4g}", report.heading.blocks, report.heading.before_rad,
            report.heading.after_rad, report.heading.in_force_rad);
  lines.add("rose {}", fmt::join(report.rose, " "));
  for (const FieldStep& step : report.steps)
    lines.add("step at {:.1f} s{}", step.time_s, step.returned ? ", returned" : "");
  for (const FieldSegment& each : report.segments)
    lines.add("segment {:.1f} to {:.1f} s, {} readings, {:.3g} {:.3g}", each.begin_s, each.end_s, each.readings,
              each.spread_raw().value_or(-9), each.spread_calibrated.value_or(-9));
  lines.add("gate {}, gaps {}", fmt::join(report.gate.taken, " "), fmt::join(report.gate.gaps, " "));
}

SuiteOptions drive_options() {
  SuiteOptions options;
  options.tilt_lag_s = 0;
  options.rate_noise_rad_sqrt_s = 0.001;
  options.local_field.declination_rad = 0.05;
  return options;
}

TEST(GoldenReport, OfAnEventfulDrive) {
  Drive drive(drive_options());
  drive.go(60, 0, 0.02);
  drive.tell("a straight leg");
  drive.go(120, 0.15, 0.05);
  drive.tell("circles to starboard");
  drive.go(120, -0.18, 0.3);
  drive.tell("circles to port, rolling");
  drive.restart();
  for (int leg = 0; leg < 4; ++leg) {
    drive.go(60, 0, 0.02, 500 + 60 * leg);
    drive.go(10, std::numbers::pi / 20, 0.05);
  }
  drive.tell("a square after a restart");
  drive.magnet_uT = {8, -5, 3};
  drive.go(90, 0.15, 0.2);
  drive.tell("with a magnet");
  drive.magnet_uT.setZero();
  drive.has_reference = false;
  drive.go(60, -0.15, 0.2);
  drive.tell("without it");
  drive.restart();
  drive.suite().finish();
  drive.tell("the end");
  drive.lines.expect_same_as("calib/drive");
}

TEST(GoldenReport, OfTheOperatorsWord) {
  SuiteOptions options = drive_options();
  options.automatic = false;
  Drive drive(options);
  drive.go(200, 0.15, 0.2);
  drive.tell("nothing comes into force by itself");
  for (const Calibrator calibrator : calibrators()) {
    drive.lines.add("accept {}: {}", name_of(calibrator), drive.suite().accept(calibrator));
    drive.lines.add("by force: {}", drive.suite().accept(calibrator, true));
  }
  drive.go(90, -0.15, 0.2);
  drive.tell("by the operator's word");
  for (const Calibrator calibrator : calibrators())
    drive.lines.add("roll back {}: {}", name_of(calibrator), drive.suite().roll_back(calibrator));
  drive.go(10, 0.1, 0.1);
  drive.tell("taken back");
  for (const Calibrator calibrator : calibrators())
    drive.lines.add("start {}: {}", name_of(calibrator), drive.suite().start(calibrator));
  drive.suite().set_local_field({0.1, KnownField{49, 1.1}});
  drive.go(100, 0.2, 0.2);
  drive.tell("begun anew, at another place");
  drive.lines.expect_same_as("calib/operator");
}

TEST(GoldenReport, OfASwingAndOfWhatIsHeldBack) {
  Drive drive(drive_options());
  drive.lines.add("start: {}", drive.suite().start(Calibrator::swing));
  drive.go(3, -0.08, 0.01, 300, 0);  // to magnetic north
  for (int eighth = 0; eighth < 9; ++eighth) {
    drive.go(14.95, 0, 0.01, 300);
    drive.go(4.95, std::numbers::pi / 20, 0.01, 300, 0);
  }
  drive.tell("eight headings");
  drive.lines.add("accept: {}", drive.suite().accept(Calibrator::swing));
  drive.go(150, 0.15, 0.2);
  drive.tell("circles");
  for (const Calibrator calibrator : {Calibrator::magnetometer, Calibrator::gyro, Calibrator::swing})
    drive.lines.add("roll back {}: {}", name_of(calibrator), drive.suite().roll_back(calibrator));
  drive.restart();
  drive.go(120, -0.15, 0.2);
  drive.tell("held back after a restart");
  drive.lines.add("start: {}", drive.suite().start(Calibrator::magnetometer));
  drive.suite().set_local_field({0.12, KnownField{47.9, 1.16}});
  drive.go(150, 0.15, 0.25);
  drive.tell("no longer held, where the declination is another");
  drive.magnet_uT = {0, 12, -6};
  drive.go(20, 0.1, 0.2);
  drive.restart();
  drive.go(100, -0.15, 0.25);
  drive.magnet_uT.setZero();
  drive.go(60, 0.15, 0.25);
  drive.tell("a magnet that came and went");
  drive.lines.expect_same_as("calib/swing");
}

}  // namespace
}  // namespace navcal::calib
