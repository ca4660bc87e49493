// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// PNI TRAX, TCM3 and Prime compasses. Manual, not at hand (ICD): TRAX user manual, chapter "Operation with PNI
/// binary protocol": length of the whole packet (u16 BE), frame number, payload (BE), CRC-16/XMODEM over all
/// before it (ICD section 11). No capture was at hand; unverified (ICD).
namespace navcal::protocols::trax {

enum class FrameNumber : std::uint8_t {
  get_module_info = 1,
  module_info = 2,
  set_data_components = 3,
  get_data = 4,
  data = 5,
  set_config = 6,
  save = 9,
  start_calibration = 10,
  stop_calibration = 11,
  save_done = 16,
  calibration_sample_count = 17,
  calibration_score = 18,
  set_config_done = 19,
  start_continuous = 21,
  stop_continuous = 22,
  set_acquisition = 24,
  acquisition_done = 26,
  take_calibration_sample = 31,
};

/// The manual's name without its k ("DataResp"), cut to sixteen letters; the number in hexadecimal where it has
/// none.
[[nodiscard]] FrameId id_of(std::uint8_t number);

inline constexpr std::size_t kOverhead = 5;

/// There is no sync: a frame begins where length and CRC agree.
struct Scanner {
  static constexpr std::size_t kMaxFrameLength = 511;

  static const std::uint8_t* find_start(const std::uint8_t* first, const std::uint8_t* last) {
    while (first != last && *first > kMaxFrameLength >> 8) ++first;
    return first;
  }
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

enum class Component : std::uint8_t {
  heading = 5,
  temperature = 7,
  distortion = 8,
  calibrated = 9,
  acceleration_x = 21,
  acceleration_y = 22,
  acceleration_z = 23,
  pitch = 24,
  roll = 25,
  field_x = 27,
  field_y = 28,
  field_z = 29,
  rate_x = 74,
  rate_y = 75,
  rate_z = 76,
  quaternion = 77,
  heading_status = 79,
};

/// kGetDataResp: the components that were asked for, in the unit of the device; angles in mils where it is set so.
struct Data {
  std::optional<double> heading_deg, pitch_deg, roll_deg;
  std::optional<double> temperature_C;
  std::optional<bool> distorted;   ///< the field is beyond what the device can measure
  std::optional<bool> calibrated;  ///< by the user
  std::array<std::optional<double>, 3> acceleration_m_s2;
  std::array<std::optional<double>, 3> field_uT;
  std::array<std::optional<double>, 3> rate_rad_s;
  std::optional<std::array<double, 4>> quaternion;
  std::optional<std::uint8_t> heading_status;
  std::size_t unread = 0;  ///< components behind one that is not known, whose size nobody can tell
  bool operator==(const Data&) const = default;
};
[[nodiscard]] std::optional<Data> decode_data(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_data(const Data& data);

/// kUserCalSampCount: samples that were taken so far.
[[nodiscard]] std::optional<std::uint32_t> decode_sample_count(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_sample_count(std::uint32_t count);

/// kUserCalScore: what the device thinks of its calibration; smaller errors are better.
struct Score {
  double magnetometer = 0, reserved = 0, accelerometer = 0, distribution_error = 0, tilt_error = 0,
         tilt_range_deg = 0;
  bool operator==(const Score&) const = default;
};
[[nodiscard]] std::optional<Score> decode_score(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_score(const Score& score);

/// Any frame; `payload` has at most 506 bytes.
[[nodiscard]] std::vector<std::uint8_t> encode_frame(FrameNumber number, Bytes payload = {});
[[nodiscard]] std::vector<std::uint8_t> encode_components(std::span<const Component> components);

/// kSetConfig.
enum class Setting : std::uint8_t {
  declination_deg = 1,             ///< float
  true_north = 2,                  ///< bool
  big_endian = 6,                  ///< bool
  mounting = 10,                   ///< u8
  calibration_points = 12,         ///< u32
  automatic_sampling = 13,         ///< bool
  baud_rate = 14,                  ///< u8, an index
  mils = 15,                       ///< bool
  angles_during_calibration = 16,  ///< bool
};
[[nodiscard]] std::vector<std::uint8_t> encode_setting(Setting setting, double value);

/// kSetAcqParams. Polled: the device answers kGetData only. Else it sends by itself after kStartContinuousMode,
/// with `interval_s` between the frames; 0: as fast as it can.
struct Acquisition {
  bool polled = false;
  double interval_s = 0;
  bool operator==(const Acquisition&) const = default;
};
[[nodiscard]] std::vector<std::uint8_t> encode_acquisition(const Acquisition& acquisition);
[[nodiscard]] std::optional<Acquisition> decode_acquisition(Bytes frame);

/// kSaveDone: whether the device has written its settings and calibration.
[[nodiscard]] std::optional<bool> decode_save_done(Bytes frame);

/// kStartCal.
enum class Calibration : std::uint32_t {
  full_range = 10,
  two_dimensional = 20,
  hard_iron = 30,
  limited_tilt = 40
};
[[nodiscard]] std::vector<std::uint8_t> encode_start_calibration(Calibration calibration);

}  // namespace navcal::protocols::trax
