// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// Teledyne Doppler logs, format PD6: lines `:XX,field,...<CR><LF>`. Manual, not at hand (ICD): Explorer and
/// Pathfinder DVL guides, chapter "PD6" (ICD section 9). The lines have no checksum: a damaged digit is not
/// noticed. Therefore only lines of known names, made of the characters that they may have, are frames. No capture
/// was at hand.
namespace navcal::protocols::pd6 {

inline constexpr FrameId kAttitude{"SA"}, kTiming{"TS"};
inline constexpr FrameId kBottomInstrument{"BI"}, kBottomShip{"BS"}, kBottomEarth{"BE"}, kBottomDistance{"BD"};
inline constexpr FrameId kWaterInstrument{"WI"}, kWaterShip{"WS"}, kWaterEarth{"WE"}, kWaterDistance{"WD"};

struct Scanner : StartsWith<':'> {
  static constexpr std::size_t kMaxFrameLength = 96;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

struct Attitude {
  double pitch_deg = 0, roll_deg = 0, heading_deg = 0;
  bool operator==(const Attitude&) const = default;
};
[[nodiscard]] std::optional<Attitude> decode_attitude(Bytes frame);

/// Lines BI, WI (x, y, z), BS, WS (transverse, longitudinal, normal), BE, WE (east, north, up).
struct Velocity {
  FrameId line;
  std::array<std::optional<double>, 3> velocity_m_s;  ///< of the instrument; absent: +-32768 on the line
  std::optional<double> error_velocity_m_s;           ///< BI and WI only
  bool good = false;                                  ///< status A
  bool operator==(const Velocity&) const = default;
};
[[nodiscard]] std::optional<Velocity> decode_velocity(Bytes frame);

/// Lines BD, WD: distance made good, as the instrument integrates it.
struct Distance {
  FrameId line;
  std::array<double, 3> east_north_up_m{};
  double range_m = 0;       ///< to the bottom, or to the middle of the water layer
  double since_good_s = 0;  ///< since the last good velocity
  bool operator==(const Distance&) const = default;
};
[[nodiscard]] std::optional<Distance> decode_distance(Bytes frame);

/// Salinity, temperature and speed of sound of TS; its clock is given as text.
struct Timing {
  std::array<char, 14> clock{};  ///< YYMMDDHHmmsshh
  double salinity_ppt = 0, temperature_C = 0, depth_m = 0, speed_of_sound_m_s = 0;
  std::uint16_t self_test = 0;  ///< 0: passed
  bool operator==(const Timing&) const = default;
};
[[nodiscard]] std::optional<Timing> decode_timing(Bytes frame);

[[nodiscard]] std::vector<std::uint8_t> encode(const Attitude& attitude);
[[nodiscard]] std::vector<std::uint8_t> encode(const Velocity& velocity);
[[nodiscard]] std::vector<std::uint8_t> encode(const Distance& distance);
[[nodiscard]] std::vector<std::uint8_t> encode(const Timing& timing);

}  // namespace navcal::protocols::pd6
