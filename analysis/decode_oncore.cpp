// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_describe.h"
#include "base/enum_name.h"
#include "protocols/oncore.h"
#include "protocols/oncore_messages.h"
#include "protocols/oncore_position.h"

namespace navcal::analysis {
namespace {

namespace oncore = protocols::oncore;
using protocols::Date;

std::string_view name_of(oncore::Antenna antenna) {
  return base::enum_name<oncore::Antenna::unknown>(antenna, {"ok", "short", "open", "unknown"});
}

std::string_view name_of(oncore::TimeRaim::Solution solution) {
  return base::enum_name<oncore::TimeRaim::Solution::unknown>(solution, {"ok", "alarm", "unknown"});
}

void write_channels(FieldWriter& fields, const oncore::Position& position) {
  fields.begin_list("channels");
  for (std::size_t i = 0; i < position.channel_count; ++i) {
    const auto& channel = position.channels[i];
    if (channel.satellite == 0) continue;
    fields.begin_object();
    fields.number("satellite", channel.satellite);
    fields.number("mode", channel.mode);
    fields.number("cn0", channel.cn0);
    fields.end_object();
  }
  fields.end_list();
}

void write(FieldWriter& fields, const oncore::Position& position) {
  if (!position.in_range) {
    write_position(fields, {});
    return write_out_of_range(fields);
  }
  const auto& place = position.filtered;
  write_position(fields, {position.date, position.time, place.latitude_deg, place.longitude_deg, place.height_m,
                          place.height_msl_m, position.speed_m_s, position.heading_deg, position.dop,
                          position.visible, position.tracked, position.fix});
  if (position.antenna) fields.text("antenna", name_of(*position.antenna));
  if (position.speed_3d_m_s) fields.number("speed_3d_m_s", *position.speed_3d_m_s, 4);
  if (position.clock_bias_ns) fields.number("clock_bias_ns", *position.clock_bias_ns);
  if (position.oscillator_offset_Hz) fields.number("oscillator_offset_Hz", *position.oscillator_offset_Hz);
  if (position.temperature_C) fields.number("temperature_C", *position.temperature_C, 1);
  if (position.utc) {
    fields.flag("leap_known", position.utc->decoded);
    fields.flag("time_is_utc", position.utc->enabled && position.utc->decoded);
    fields.number("utc_offset_s", position.utc->decoded ? std::optional(position.utc->offset_s) : std::nullopt);
  }
  if (position.channel_count > 0) write_channels(fields, position);
}

void write(FieldWriter& fields, const oncore::VisibleSatellites& sky) {
  fields.number("visible", sky.visible);
  fields.objects("satellites", std::span(sky.satellites).first(sky.count), [&](const auto& satellite) {
    fields.number("satellite", satellite.number);
    fields.number("doppler_Hz", satellite.doppler_Hz);
    fields.number("elevation_deg", satellite.elevation_deg);
    fields.number("azimuth_deg", satellite.azimuth_deg);
    fields.number("health", satellite.health);
  });
  if (!sky.in_range) write_out_of_range(fields);
}

// The date of the last change may lie years back, so it is shown as sent.
void write(FieldWriter& fields, const oncore::LeapAnnouncement& leap) {
  fields.number("present_s", leap.present_s);
  fields.number("future_s", leap.future_s);
  fields.flag("pending", leap.pending());
  if (leap.in_range) return fields.time("change", leap.date, leap.time);
  fields.null("change");
  write_out_of_range(fields);
}

void write(FieldWriter& fields, const oncore::TimeRaim& raim) {
  fields.flag("pulse_on", raim.pulse_on);
  fields.text("pulse_of", raim.pulse_of_utc ? "utc" : "gps");
  fields.text("solution", name_of(raim.solution));
  fields.number("accuracy_ns", raim.accuracy_ns);
  fields.number("sawtooth_ns", raim.sawtooth_ns);
  fields.number("removed", raim.removed);
}

}  // namespace

void describe_oncore(FieldWriter& fields, const protocols::Frame& frame) {
  if (const auto position = oncore::decode_position(frame.bytes)) return write(fields, *position);
  if (frame.id == oncore::kBb) return write(fields, *oncore::decode_bb(frame.bytes));
  if (frame.id == oncore::kGj) return write(fields, *oncore::decode_gj(frame.bytes));
  if (frame.id == oncore::kHn) return write(fields, *oncore::decode_hn(frame.bytes));
  if (frame.id == oncore::kCj) return fields.text("text", *oncore::decode_cj(frame.bytes));
  if (frame.id == oncore::kBo) {
    const auto offset_s = oncore::decode_bo(frame.bytes)->offset_s;
    fields.number("utc_offset_s", offset_s);
    return fields.flag("leap_known", offset_s.has_value());
  }
  if (frame.id == oncore::kEq) {
    write_position(fields, {});
    write_out_of_range(fields);
  }
}

}  // namespace navcal::analysis
