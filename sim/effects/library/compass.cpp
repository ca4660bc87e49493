// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "sim/effects/library/library.h"
#include "sim/effects/low_pass.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kCompassLag = described(
    "compass_lag", "tau m' + m = field", {{"tau_s", 0.2, 0, 10}}, "turn both ways at two different rates",
    {.confounders = {"imu_latency", "gyro_scale"}, .order = 4, .kind = EffectKind::lag});
/// The compass filters its magnetometers, hence its heading.
struct CompassLag final : EffectOf<CompassLag, kCompassLag> {
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    field_body_uT = filter_.at(now.time_s, field_body_uT, p_[0]);
  }

 private:
  LowPass filter_;
};

constexpr EffectDescription kCompassMisalignment =
    described("compass_misalignment", "m = (1 - [a]x) m, as a rotation", alike("x_deg y_deg z_deg", 3, -45, 45),
              "steer by GPS course and pitch up and down",
              {.confounders = {"tilt_offset", "declination", "hard_iron", "soft_iron"}, .vector = 3, .order = 1});
/// The triad of magnetometers is turned by the vector a against body and inclinometer.
struct CompassMisalignment final : EffectOf<CompassMisalignment, kCompassMisalignment> {
  void body_field(const Instant&, Vector3& field_body_uT) override {
    const double angle = std::hypot(p_[0], p_[1], p_[2]) * base::kRadiansPerDegree;
    if (angle == 0) return;
    const Vector3 m = field_body_uT;
    Vector3 axis{};
    add_scaled(axis, base::kRadiansPerDegree / angle, vector());
    const double along = axis[0] * m[0] + axis[1] * m[1] + axis[2] * m[2];
    // Rodrigues' formula, backwards.
    for (double& component : field_body_uT) component *= std::cos(angle);
    add_scaled(field_body_uT, -std::sin(angle), cross(axis, m));
    add_scaled(field_body_uT, (1 - std::cos(angle)) * along, axis);
  }
};

constexpr EffectDescription kDeclination = described("declination", "B = Rz(d) B", {{"angle_deg", 4, -180, 180}},
                                                     "run straight at the surface on three headings",
                                                     {.confounders = {"compass_misalignment", "water_current"}});
/// The earth's field is turned about the vertical, positive to the east.
struct Declination final : EffectOf<Declination, kDeclination> {
  void earth_field(const Instant&, Vector3& field_world_uT) override {
    const double c = std::cos(p_[0] * base::kRadiansPerDegree), s = std::sin(p_[0] * base::kRadiansPerDegree);
    const auto [north, east, down] = field_world_uT;
    field_world_uT = {c * north - s * east, s * north + c * east, down};
  }
};

constexpr EffectDescription kHardIron = described(
    "hard_iron", "m += b", alike("x_uT y_uT z_uT", 2, -200, 200), "turn full circles with pitch of both signs",
    {.confounders = {"soft_iron", "compass_misalignment", "motor_field", "mag_temperature"}, .vector = 3});
/// Permanent magnetism of the vehicle.
struct HardIron final : EffectOf<HardIron, kHardIron> {
  void body_field(const Instant&, Vector3& field_body_uT) override { add_scaled(field_body_uT, 1, vector()); }
};

constexpr EffectDescription kMagTemperature = described(
    "mag_temperature", "m += c T, T above 15 C", alike("x_uT_per_C y_uT_per_C z_uT_per_C", 0.15, -10, 10),
    "let the electronics warm up with the motor off", {.confounders = {"hard_iron", "gyro_drift"}, .vector = 3});
/// The magnetometers' zeros move as the electronics warm up.
struct MagTemperature final : EffectOf<MagTemperature, kMagTemperature> {
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    add_scaled(field_body_uT, now.temperature_rise_C(), vector());
  }
};

constexpr double kMemory_s = 60;

constexpr EffectDescription kMagneticHysteresis =
    described("magnetic_hysteresis", "m += k lowpass(m, 60 s)", {{"gain", 0.06, -0.03, 1}},
              "come to the same heading from both sides", {.confounders = {"hard_iron", "soft_iron"}, .order = 2});
/// Iron that remembers the field of the last minute.
struct MagneticHysteresis final : EffectOf<MagneticHysteresis, kMagneticHysteresis> {
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    add_scaled(field_body_uT, p_[0], memory_.at(now.time_s, field_body_uT, kMemory_s));
  }

 private:
  LowPass memory_;
};

constexpr EffectDescription kMotorField = described(
    "motor_field", "m += k I", alike("x_uT_per_A y_uT_per_A z_uT_per_A", 1, -50, 50),
    "step the motor current on a constant heading", {.confounders = {"hard_iron", "adc_droop"}, .vector = 3});
/// The motor's supply makes a field of its own.
struct MotorField final : EffectOf<MotorField, kMotorField> {
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    add_scaled(field_body_uT, now.state.motor_current_A, vector());
  }
};

// The Frobenius norm of S counts, in which what stands off the diagonal counts twice.
constexpr double kNorm = 0.05;

constexpr EffectDescription kSoftIron = described(
    "soft_iron", "m = (1 + S) m, S symmetric",
    {{"xx", kNorm, -0.5, 0.5},
     {"yy", kNorm, -0.5, 0.5},
     {"zz", kNorm, -0.5, 0.5},
     {"xy", kNorm / std::numbers::sqrt2, -0.5, 0.5},
     {"xz", kNorm / std::numbers::sqrt2, -0.5, 0.5},
     {"yz", kNorm / std::numbers::sqrt2, -0.5, 0.5}},
    "turn full circles at two pitch angles",
    {.confounders = {"hard_iron", "compass_misalignment", "magnetic_hysteresis"}, .vector = 6, .order = 0});
/// Iron that the field itself magnetises, without preferred rotation.
struct SoftIron final : EffectOf<SoftIron, kSoftIron> {
  void body_field(const Instant&, Vector3& field_body_uT) override {
    const auto [xx, yy, zz, xy, xz, yz] = p_;
    const Matrix3 more{{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
    add_scaled(field_body_uT, 1, more * field_body_uT);
  }
};

constexpr EffectDescription kTiltOffset =
    described("tilt_offset", "tilt += o", {{"roll_deg", 1, -45, 45}, {"pitch_deg", 1, -45, 45}},
              "pitch up and down by the same angle", {.confounders = {"accel_bias", "compass_misalignment"}});
/// The inclinometer is mounted askew.
struct TiltOffset final : EffectOf<TiltOffset, kTiltOffset> {
  void tilt_said(const Instant&, Tilt& tilt) override {
    tilt.roll_rad += p_[0] * base::kRadiansPerDegree;
    tilt.pitch_rad += p_[1] * base::kRadiansPerDegree;
  }
};

constexpr EffectDescription kTiltSlosh =
    described("tilt_slosh", "roll -= k a_y/g, pitch += k a_x/g, before the fluid's lag", {{"gain", 0.3, -0.15, 2}},
              "turn at one rate and two speeds");
/// The inclinometer's fluid sees gravity less a share of the vehicle's acceleration.
struct TiltSlosh final : EffectOf<TiltSlosh, kTiltSlosh> {
  void tilt_seen(const Instant& now, Tilt& tilt) override {
    const Vector3 acceleration = now.acceleration_m_s2();
    tilt.roll_rad -= p_[0] * acceleration[1] / kGravity_m_s2;
    tilt.pitch_rad += p_[0] * acceleration[0] / kGravity_m_s2;
  }
};

}  // namespace

std::span<const EffectEntry> effects_of_compass() {
  return entries_of<CompassLag, CompassMisalignment, Declination, HardIron, MagTemperature, MagneticHysteresis,
                    MotorField, SoftIron, TiltOffset, TiltSlosh>();
}

}  // namespace navcal::sim
