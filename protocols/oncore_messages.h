// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "protocols/frame.h"
#include "protocols/utc.h"

namespace navcal::protocols::oncore {

/// Bb: the satellites above the horizon, by almanac.
struct VisibleSatellites {
  struct Satellite {
    std::uint8_t number = 0;  ///< PRN
    std::int16_t doppler_Hz = 0;
    std::uint8_t elevation_deg = 0;
    std::uint16_t azimuth_deg = 0;
    std::uint8_t health = 0;  ///< 0: healthy and not excluded
  };
  static constexpr std::size_t kSlots = 12;

  std::uint8_t visible = 0;  ///< as stated; real receivers state 13 and send twelve
  std::size_t count = 0;     ///< slots in use
  std::array<Satellite, kSlots> satellites{};
  bool in_range = false;  ///< elevations up to 90 and azimuths up to 360 degrees
};
[[nodiscard]] std::optional<VisibleSatellites> decode_bb(Bytes frame);

/// Bo: seconds that GPS time is ahead of UTC; nullopt inside while the receiver does not know them. Until it does,
/// the times that it reports are GPS time.
struct UtcOffset {
  std::optional<std::int8_t> offset_s;
};
[[nodiscard]] std::optional<UtcOffset> decode_bo(Bytes frame);

/// Gj: the leap second that is in force and the one to come. The date is that of the change, as sent.
struct LeapAnnouncement {
  std::int8_t present_s = 0;
  std::int8_t future_s = 0;
  Date date;
  TimeOfDay time;
  bool in_range = false;

  [[nodiscard]] bool pending() const { return future_s != present_s; }
};
[[nodiscard]] std::optional<LeapAnnouncement> decode_gj(Bytes frame);

/// Hn: autonomous integrity monitoring of time (12 channels).
struct TimeRaim {
  enum class Solution : std::uint8_t { ok, alarm, unknown };

  bool pulse_on = false;
  bool pulse_of_utc = false;  ///< else of GPS time
  Solution solution = Solution::unknown;
  std::uint8_t method = 0;        ///< 0 detection and isolation, 1 detection only, 2 neither
  std::uint32_t removed = 0;      ///< one bit a satellite
  std::uint16_t accuracy_ns = 0;  ///< one sigma of the solution
  std::int8_t sawtooth_ns = 0;    ///< negative saw tooth of the next pulse
};
[[nodiscard]] std::optional<TimeRaim> decode_hn(Bytes frame);

/// Cj: text of 25-column lines, CR LF between them. The view lies in the frame.
[[nodiscard]] std::optional<std::string_view> decode_cj(Bytes frame);

}  // namespace navcal::protocols::oncore
