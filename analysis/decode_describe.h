// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "analysis/decode_fields.h"
#include "analysis/decode_summary.h"
#include "protocols/frame.h"
#include "protocols/gps_fix.h"
#include "protocols/utc.h"

namespace navcal::analysis {

/// Writes the decoded fields of one frame, with the keys of docs/cli.md.
using FrameDescription = void(FieldWriter& fields, const protocols::Frame& frame);
using Describe = FrameDescription*;

FrameDescription describe_tcm2, describe_imu_card, describe_motor_card, describe_mavlink, describe_oncore,
    describe_nmea, describe_samples, describe_pd0, describe_pd6, describe_water_linked, describe_paroscientific,
    describe_keller, describe_mip, describe_pni, describe_ubx, describe_vectornav;

/// The date and time of a message, null when one of them is absent.
void write_time(FieldWriter& fields, const std::optional<protocols::Date>& date,
                const std::optional<protocols::TimeOfDay>& time);

/// The keys that every message with a position has, whatever its protocol.
struct PositionFields {
  std::optional<protocols::Date> date;
  std::optional<protocols::TimeOfDay> time;
  std::optional<double> lat, lon;      ///< degrees
  std::optional<double> height_m;      ///< above the ellipsoid
  std::optional<double> height_msl_m;  ///< above mean sea level
  std::optional<double> speed_m_s, heading_deg, dop;
  std::optional<std::uint8_t> visible, tracked;
  std::optional<protocols::Fix> fix;
};
void write_position(FieldWriter& fields, const PositionFields& position);

/// The frame is intact, but its content cannot be.
void write_out_of_range(FieldWriter& fields);

/// Hands on the frames of a whole stream of the device that speaks `protocol`. `next` gives the bytes, piece by
/// piece, an empty piece at the end.
DecodeSummary decode_frames(protocols::Protocol protocol, const std::function<protocols::Bytes()>& next,
                            const std::function<void(const protocols::Frame&)>& on_frame);

/// What writes the fields of the frames of the device that speaks `protocol`.
[[nodiscard]] Describe description_of(protocols::Protocol protocol);

}  // namespace navcal::analysis
