// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "devices/instrument_model.h"
#include "gap/data/earth_field.h"
#include "instruments/samples.h"
#include "pipeline/pipeline.h"
#include "sim/state.h"

namespace navcal::gap {

// Times are seconds since the recording's first byte, body axes x forward, y starboard, z down.

struct CompassReading {
  double time_s = 0;
  std::optional<double> heading_rad;  ///< magnetic
  double roll_rad = 0, pitch_rad = 0;
  Vector3 field_uT{};
  std::optional<double> electronics_C;
};

struct CardReading {
  double time_s = 0;
  std::array<double, 4> gyro_rad_s{};  ///< A-x, A-z, B-y, B-z
  Vector3 force_m_s2{};
  double depth_m = 0;
};

struct FixReading {
  double time_s = 0;
  std::array<double, 2> position_m{};                   ///< north, east of the mission's first fix
  std::optional<std::array<double, 2>> velocity_m_s{};  ///< north, east over ground; none below the course gate
  int number = 0;                                       ///< since the sky came in sight; the first ones are poor
};

struct MotorReading {
  double time_s = 0;
  double rpm = 0;
  Vector3 fins_rad{};
  double current_A = 0;
};

/// What the instruments of one mission said, each in order of time.
struct Mission {
  std::vector<CompassReading> compass;
  std::vector<CardReading> card;
  std::vector<FixReading> fixes;
  std::vector<MotorReading> motor;
  /// What the motor card's statuses lack, where every one lacks it: "shaft speed". Empty: nothing, or no card.
  std::string motor_lacks;
  /// When the motor card was told something new. Empty: not recorded.
  std::vector<double> order_times_s;
  double duration_s = 0;
  std::uint64_t distorted = 0;  ///< words of the compass with its remark of magnetic distortion (E001)
  std::vector<std::string> remarks;
  EarthField field;
  /// As the configuration of the recording states them.
  devices::InstrumentModel instruments;

  [[nodiscard]] std::vector<double> fix_times_s() const;
  /// Why nothing can be said from it ("no inertial card: ..."); empty: something can.
  [[nodiscard]] std::string shortcoming() const;
};

/// Gathers a mission from a pipeline. Readings that lack a part that is needed, or are not finite, are left out.
class MissionGatherer final : public pipeline::Sink {
 public:
  void on_sample(const instruments::Sample& sample) override;
  /// What the recording says beside its readings.
  struct Said {
    std::optional<Vector3> field_uT{};     ///< the Earth's
    std::int64_t utc_minus_stamps_ns = 0;  ///< by its mapping
  };
  /// Sorted, with times from `begin_ns` (the scale of the stamps) on.
  [[nodiscard]] Mission take(std::int64_t begin_ns, const Said& said);

 private:
  void add(const instruments::CompassSample& sample, std::int64_t time_ns);
  void add(const instruments::ImuSample& sample, std::int64_t time_ns);
  void add(const instruments::GpsSample& sample, std::int64_t time_ns);
  void add(const instruments::MotorSample& sample, std::int64_t time_ns);

  [[nodiscard]] EarthField field(const Said& said) const;

  Mission mission_;
  std::vector<std::int64_t> times_ns_[4];
};

/// The settings with nothing of the pipeline but stamped samples.
[[nodiscard]] config::Settings samples_only(config::Settings settings);

/// Reads a log or a capture through the pipeline. `stated`: the configuration to use instead of the recording's
/// own; ports that it lacks are left out, with a remark. `progress` gets 0 to 1. Throws record::BadRecording.
[[nodiscard]] Mission load_mission(const std::filesystem::path& file, const std::function<void(double)>& progress,
                                   const std::optional<config::Settings>& stated = std::nullopt);

}  // namespace navcal::gap
