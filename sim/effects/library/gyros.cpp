// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include "base/angles.h"
#include "sim/effects/library/library.h"
#include "sim/noise.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGyroCrossAxis = described(
    "gyro_cross_axis", "w_i += k w_j",
    alike("ax_from_y ax_from_z az_from_x az_from_y by_from_x by_from_z bz_from_x bz_from_y", 0.03, -0.5, 0.5),
    "turn level, then turn pitched up",
    {.confounders = {"compass_misalignment", "tilt_offset", "gyro_g_sensitivity"}});
/// Each gyro feels the rates about the two other axes.
struct GyroCrossAxis final : EffectOf<GyroCrossAxis, kGyroCrossAxis> {
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    const double* factor = p_.data();
    for (std::size_t i = 0; i < rate_rad_s.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis != kGyroAxes[i]) rate_rad_s[i] += *factor++ * now.state.rate_rad_s[axis];
      }
    }
  }
};

constexpr EffectDescription kGyroDrift = described(
    "gyro_drift", "w += c t", alike("deg_per_s2_ax deg_per_s2_az deg_per_s2_by deg_per_s2_bz", 0.001, -1, 1),
    "run long straight legs", {.confounders = {"gyro_temperature"}});
/// Each gyro's zero drifts steadily from the beginning of the mission.
struct GyroDrift final : EffectOf<GyroDrift, kGyroDrift> {
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i) rate_rad_s[i] += p_[i] * base::kRadiansPerDegree * now.time_s;
  }
};

constexpr EffectDescription kGyroGSensitivity =
    described("gyro_g_sensitivity", "w_i += G_i . f",
              alike("ax_x_deg_per_s_per_g ax_y_deg_per_s_per_g ax_z_deg_per_s_per_g az_x_deg_per_s_per_g "
                    "az_y_deg_per_s_per_g az_z_deg_per_s_per_g by_x_deg_per_s_per_g by_y_deg_per_s_per_g "
                    "by_z_deg_per_s_per_g bz_x_deg_per_s_per_g bz_y_deg_per_s_per_g bz_z_deg_per_s_per_g",
                    0.6, -50, 50),
              "hold a pitch without turning", {.confounders = {"tilt_offset", "gyro_cross_axis"}, .vector = 3});
/// Each gyro feels the specific force, too.
struct GyroGSensitivity final : EffectOf<GyroGSensitivity, kGyroGSensitivity> {
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    const Vector3& force = now.state.specific_force_m_s2;
    for (std::size_t i = 0; i < rate_rad_s.size(); ++i) {
      const Vector3 g = vector(3 * i);
      rate_rad_s[i] +=
          (g[0] * force[0] + g[1] * force[1] + g[2] * force[2]) * base::kRadiansPerDegree / kGravity_m_s2;
    }
  }
};

constexpr EffectDescription kGyroNonlinearity =
    described("gyro_nonlinearity", "w += k w |w|",
              alike("s_per_deg_ax s_per_deg_az s_per_deg_by s_per_deg_bz", 0.0008, -0.01, 0.01),
              "turn at two very different rates", {.confounders = {"gyro_scale"}});
/// Each gyro's scale grows with the rate.
struct GyroNonlinearity final : EffectOf<GyroNonlinearity, kGyroNonlinearity> {
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const double rate = now.state.rate_rad_s[kGyroAxes[i]];
      rate_rad_s[i] += p_[i] / base::kRadiansPerDegree * rate * std::abs(rate);
    }
  }
};

constexpr EffectDescription kGyroRandomWalk =
    described("gyro_random_walk", "w += integral of white noise",
              alike("deg_per_s_per_sqrt_s_ax deg_per_s_per_sqrt_s_az deg_per_s_per_sqrt_s_by "
                    "deg_per_s_per_sqrt_s_bz",
                    0.002, 0, 1),
              TellingManoeuvre::none(), {.place = EffectPlace::lines});
/// Each gyro's zero walks at random.
struct GyroRandomWalk final : EffectOf<GyroRandomWalk, kGyroRandomWalk> {
  void reseed(std::uint64_t seed) override { noise_ = Noise(seed); }
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    const double root = std::sqrt(std::max(0.0, now.time_s - time_s_.value_or(now.time_s)));
    time_s_ = now.time_s;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      walk_rad_s_[i] += noise_.normal(p_[i] * base::kRadiansPerDegree * root);
      rate_rad_s[i] += walk_rad_s_[i];
    }
  }

 private:
  Noise noise_{1};
  std::optional<double> time_s_;
  GyroRates walk_rad_s_{};
};

constexpr EffectDescription kGyroScale =
    described("gyro_scale", "w += k w", alike("scale_ax scale_az scale_by scale_bz", 0.03, -0.9, 1),
              "turn two full revolutions one way",
              {.confounders = {"fin_gain", "imu_latency", "compass_lag", "gyro_nonlinearity"}});
/// Each gyro's scale is off.
struct GyroScale final : EffectOf<GyroScale, kGyroScale> {
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i) rate_rad_s[i] += p_[i] * now.state.rate_rad_s[kGyroAxes[i]];
  }
};

constexpr EffectDescription kGyroTemperature =
    described("gyro_temperature", "w += c T, T above 15 C",
              alike("deg_per_s_per_C_ax deg_per_s_per_C_az deg_per_s_per_C_by deg_per_s_per_C_bz", 0.06, -5, 5),
              "run once from cold and once warmed up", {.confounders = {"gyro_drift"}});
/// Each gyro's zero moves as the electronics warm up.
struct GyroTemperature final : EffectOf<GyroTemperature, kGyroTemperature> {
  void gyros(const Instant& now, GyroRates& rate_rad_s) override {
    for (std::size_t i = 0; i < p_.size(); ++i)
      rate_rad_s[i] += p_[i] * base::kRadiansPerDegree * now.temperature_rise_C();
  }
};

}  // namespace

std::span<const EffectEntry> effects_of_gyros() {
  return entries_of<GyroCrossAxis, GyroDrift, GyroGSensitivity, GyroNonlinearity, GyroRandomWalk, GyroScale,
                    GyroTemperature>();
}

}  // namespace navcal::sim
