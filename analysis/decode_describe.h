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

/// Writes the decoded fields of one frame, with the keys of docs/cli.md. `pivot`: dates before it are moved up by
/// whole epochs of 1024 weeks; nullopt: dates as sent.
using Describe = void (*)(FieldWriter& fields, const protocols::Frame& frame,
                          const std::optional<protocols::Date>& pivot);

void describe_tcm2(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_imu_card(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_motor_card(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_mavlink(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_oncore(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_nmea(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_samples(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_pd0(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_pd6(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_water_linked(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_paroscientific(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_keller(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_mip(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_pni(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_ubx(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);
void describe_vectornav(FieldWriter&, const protocols::Frame&, const std::optional<protocols::Date>&);

/// The date and time of a message, null when one of them is absent.
void write_time(FieldWriter& fields, const std::optional<protocols::Date>& date,
                const std::optional<protocols::TimeOfDay>& time, const std::optional<protocols::Date>& pivot);

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
void write_position(FieldWriter& fields, const PositionFields& position,
                    const std::optional<protocols::Date>& pivot);

/// The frame is intact, but its content cannot be.
void write_out_of_range(FieldWriter& fields);

/// Hands on the frames of a whole stream of the device that speaks `protocol`. `next` gives the bytes, piece by
/// piece, an empty piece at the end.
DecodeSummary decode_frames(protocols::Protocol protocol, const std::function<protocols::Bytes()>& next,
                            const std::function<void(const protocols::Frame&)>& on_frame);

/// What writes the fields of the frames of the device that speaks `protocol`.
[[nodiscard]] Describe description_of(protocols::Protocol protocol);

}  // namespace navcal::analysis
