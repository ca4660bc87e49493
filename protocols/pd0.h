// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"
#include "protocols/utc.h"

/// Teledyne RDI Doppler logs and current profilers, format PD0. Manual, not at hand (ICD): WorkHorse "Commands and
/// Output Data Format", chapter "PD0": 7F 7F, length without checksum (u16 LE), number and offsets of the data
/// types, data, sum of all bytes (u16 LE) (ICD section 8).
namespace navcal::protocols::pd0 {

inline constexpr FrameId kEnsemble{"ENSEMBLE"};
/// The longest profile, 255 cells of four beams with four quantities, has less than 6000 bytes.
inline constexpr std::size_t kMaxLength = 8192;

struct Scanner : StartsWith<0x7F> {
  static constexpr std::size_t kMaxFrameLength = kMaxLength;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

/// Axes of the velocities, as the fixed leader names them. Instrument and ship are starboard, forward, up where
/// the instrument is mounted as the manual shows; the fourth value is the error velocity. Earth is east, north,
/// up.
enum class Axes : std::uint8_t { beam, instrument, ship, earth };

/// Fixed leader, 0x0000.
struct FixedLeader {
  std::uint8_t firmware_version = 0, firmware_revision = 0;
  std::uint16_t system = 0;  ///< bits 0 to 2 frequency, 3 convex, 7 looks upwards, 8 and 9 beam angle
  std::uint8_t beams = 0, cells = 0;
  Axes axes = Axes::beam;
  bool uses_tilts = false, allows_three_beams = false, maps_bins = false;
  double heading_alignment_deg = 0;        ///< azimuth of beam 3 from the bow, positive to starboard
  double heading_bias_deg = 0;             ///< added to the heading: the declination, where it was set
  std::uint8_t used_sensors = 0;           ///< bits of Sensor; others are settings of the host
  std::uint8_t fitted_sensors = 0;         ///< bits of Sensor
  std::uint8_t stated_beam_angle_deg = 0;  ///< 0: the leader is too short to state it
  bool operator==(const FixedLeader&) const = default;

  [[nodiscard]] bool looks_up() const { return (system & 0x80U) != 0; }
  [[nodiscard]] bool is_convex() const { return (system & 0x08U) != 0; }
  /// Between a beam and the instrument's axis; nullopt when the leader does not say it.
  [[nodiscard]] std::optional<double> beam_angle_deg() const;
};

enum Sensor : std::uint8_t {
  temperature_sensor = 1,
  conductivity_sensor = 2,
  roll_sensor = 4,
  pitch_sensor = 8,
  heading_sensor = 16,
  depth_sensor = 32
};

/// Whether the variable leader's value is measured by the instrument: a sensor that is fitted and used.
[[nodiscard]] constexpr bool is_measured(const FixedLeader& fixed, Sensor sensor) {
  return (fixed.used_sensors & fixed.fitted_sensors & sensor) != 0;
}

/// Variable leader, 0x0080.
struct VariableLeader {
  std::uint32_t ensemble = 0;
  Date date;  ///< clock of the instrument, which has no time zone
  TimeOfDay time;
  std::uint16_t self_test = 0;  ///< 0: passed
  double speed_of_sound_m_s = 0, depth_m = 0;
  double heading_deg = 0, pitch_deg = 0, roll_deg = 0;
  double salinity_ppt = 0, temperature_C = 0;
  std::optional<double> pressure_Pa;  ///< relative to the surface; absent in the short leader
  bool operator==(const VariableLeader&) const = default;
};

/// Bottom track, 0x0600. Signs are as sent: the bottom's velocity relative to the instrument, and the water's.
struct BottomTrack {
  std::array<std::optional<double>, 4> range_m;  ///< vertical, of each beam; absent: bottom not found
  std::array<std::optional<double>, 4>
      velocity_m_s;  ///< in the axes of the fixed leader; absent: -32768 on the wire
  std::array<std::uint8_t, 4> correlation{}, amplitude{}, percent_good{};
  std::array<std::optional<double>, 4> water_velocity_m_s;  ///< of the reference layer
  std::array<std::uint8_t, 4> water_percent_good{};
  bool operator==(const BottomTrack&) const = default;
};

struct Ensemble {
  std::optional<FixedLeader> fixed;
  std::optional<VariableLeader> variable;
  std::optional<BottomTrack> bottom;
  std::size_t unknown_types = 0;  ///< without a decoder here: profiles among them
  std::size_t invalid_types = 0;  ///< too short, or with an offset beyond the end
  bool operator==(const Ensemble&) const = default;
};
[[nodiscard]] Ensemble decode(Bytes frame);
/// The parts that are present, in the order of the members.
[[nodiscard]] std::vector<std::uint8_t> encode(const Ensemble& ensemble);
/// An ensemble of any data types: each begins with its number.
[[nodiscard]] std::vector<std::uint8_t> encode_types(const std::vector<std::vector<std::uint8_t>>& types);

}  // namespace navcal::protocols::pd0
