// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_describe.h"
#include "protocols/nmea_attitude.h"
#include "protocols/nmea_position.h"

namespace navcal::analysis {
namespace {

namespace nmea = protocols::nmea;
using nmea::Decimal;
using nmea::Type;
using protocols::Date;
using protocols::Frame;

std::optional<double> value_of(const std::optional<Decimal>& number, double unit = 1) {
  return number ? std::optional<double>(number->value() * unit) : std::nullopt;
}

void place_into(PositionFields& out, const std::optional<nmea::LatLon>& place) {
  if (!place) return;
  out.lat = place->latitude_deg;
  out.lon = place->longitude_deg;
}

// Sentences with a time and no date.
void write_time_of_day(FieldWriter& fields, const std::optional<protocols::TimeOfDay>& time) {
  if (!time) return fields.null("time_of_day");
  fields.time_of_day("time_of_day", *time);
}

void write(FieldWriter& fields, const nmea::Gga& gga) {
  PositionFields position;
  place_into(position, gga.place);
  position.height_msl_m = value_of(gga.altitude_m);
  if (gga.altitude_m && gga.geoid_separation_m) {
    position.height_m = gga.altitude_m->value() + gga.geoid_separation_m->value();
  }
  position.dop = value_of(gga.hdop);
  position.tracked = gga.satellites;
  position.fix = gga.fix();
  write_position(fields, position);
  write_time_of_day(fields, gga.time);
  fields.number("quality", gga.quality);
  fields.number("geoid_separation_m", gga.geoid_separation_m);
}

void write(FieldWriter& fields, const nmea::Rmc& rmc) {
  PositionFields position;
  position.date = rmc.date;
  position.time = rmc.time;
  place_into(position, rmc.place);
  position.speed_m_s = value_of(rmc.speed_kn, protocols::kMetresPerSecondPerKnot);
  position.heading_deg = value_of(rmc.course_deg);
  position.fix = rmc.fix();
  write_position(fields, position);
  fields.number("variation_deg", rmc.variation_deg);
  fields.letter("mode", rmc.mode);
}

void write(FieldWriter& fields, const nmea::Gll& gll) {
  PositionFields position;
  place_into(position, gll.place);
  position.fix = gll.fix();
  write_position(fields, position);
  write_time_of_day(fields, gll.time);
  fields.letter("mode", gll.mode);
}

void write(FieldWriter& fields, const nmea::Vtg& vtg) {
  const auto knots = value_of(vtg.speed_kn, protocols::kMetresPerSecondPerKnot);
  fields.number("heading_deg", vtg.course_true_deg);
  fields.number("heading_magnetic_deg", vtg.course_magnetic_deg);
  fields.number("speed_m_s", knots ? knots : value_of(vtg.speed_km_h, 1 / 3.6), 4);
  fields.letter("mode", vtg.mode);
}

void write(FieldWriter& fields, const nmea::Gsa& gsa) {
  fields.text("fix", name_of(gsa.fix));
  fields.number("pdop", gsa.pdop);
  fields.number("hdop", gsa.hdop);
  fields.number("vdop", gsa.vdop);
  fields.numbers("satellites", std::span(gsa.satellites).first(gsa.count));
}

void write(FieldWriter& fields, const nmea::Gsv& gsv) {
  fields.number("sentences", gsv.sentences);
  fields.number("sentence", gsv.sentence);
  fields.number("visible", gsv.visible);
  fields.objects("satellites", std::span(gsv.satellites).first(gsv.count), [&](const auto& satellite) {
    fields.number("satellite", satellite.number);
    fields.number("elevation_deg", satellite.elevation_deg);
    fields.number("azimuth_deg", satellite.azimuth_deg);
    fields.number("cn0_dBHz", satellite.cn0_dBHz);
  });
}

void write(FieldWriter& fields, const nmea::Zda& zda) {
  write_time(fields, zda.date, zda.time);
  fields.number("zone_min", zda.zone_min);
}

void write(FieldWriter& fields, const nmea::Heading& heading) {
  fields.number("heading_deg", heading.heading_deg);
  fields.text("reference", heading.is_true ? "true" : "magnetic");
  fields.number("deviation_deg", heading.deviation_deg);
  fields.number("variation_deg", heading.variation_deg);
  fields.letter("mode", heading.mode);
}

void write(FieldWriter& fields, const nmea::Attitude& attitude) {
  fields.number("heading_deg", attitude.heading_deg);
  fields.number("pitch_deg", attitude.pitch_deg);
  fields.number("roll_deg", attitude.roll_deg);
}

void write(FieldWriter& fields, const nmea::Rot& rot) {
  fields.number("rate_deg_min", rot.rate_deg_min);
  fields.flag("valid", rot.valid);
}

void write(FieldWriter& fields, const nmea::Xdr& xdr) {
  fields.objects("transducers", std::span(xdr.transducers).first(xdr.count), [&](const auto& transducer) {
    fields.letter("type", transducer.type);
    fields.number("value", transducer.value);
    fields.letter("unit", transducer.unit);
    fields.text("name", transducer.name);
  });
}

void write(FieldWriter& fields, const nmea::Ptnthtm& tilt) {
  fields.number("heading", tilt.heading);
  fields.letter("magnetic_status", tilt.magnetic_status);
  fields.number("pitch", tilt.pitch);
  fields.letter("pitch_status", tilt.pitch_status);
  fields.number("roll", tilt.roll);
  fields.letter("roll_status", tilt.roll_status);
  fields.number("dip", tilt.dip);
  fields.number("horizontal_field", tilt.horizontal_field);
}

void write(FieldWriter& fields, const nmea::Depth& depth) {
  fields.number("depth_m", depth.depth_m, 3);
  fields.number("offset_m", depth.offset_m);
}

// Decoded, or all fields null and said to be out of range.
template <class Message>
void write_or_refuse(FieldWriter& fields, const std::optional<Message>& message) {
  write(fields, message ? *message : Message{});
  if (!message) write_out_of_range(fields);
}

}  // namespace

void describe_nmea(FieldWriter& fields, const Frame& frame) {
  const nmea::Type type = nmea::type_of(frame.id);
  if (type == Type::other) return;
  const nmea::Sentence sentence(frame.bytes);
  switch (type) {
    case Type::gga: return write_or_refuse(fields, nmea::decode_gga(sentence));
    case Type::gns: return write_or_refuse(fields, nmea::decode_gns(sentence));
    case Type::rmc: return write_or_refuse(fields, nmea::decode_rmc(sentence));
    case Type::vtg: return write_or_refuse(fields, nmea::decode_vtg(sentence));
    case Type::gll: return write_or_refuse(fields, nmea::decode_gll(sentence));
    case Type::gsa: return write_or_refuse(fields, nmea::decode_gsa(sentence));
    case Type::gsv: return write_or_refuse(fields, nmea::decode_gsv(sentence));
    case Type::zda: return write_or_refuse(fields, nmea::decode_zda(sentence));
    case Type::hdt:
    case Type::hdm:
    case Type::hdg:
    case Type::ths: return write_or_refuse(fields, nmea::decode_heading(sentence, type));
    case Type::attitude: return write_or_refuse(fields, nmea::decode_attitude(sentence));
    case Type::rot: return write_or_refuse(fields, nmea::decode_rot(sentence));
    case Type::xdr: return write_or_refuse(fields, nmea::decode_xdr(sentence));
    case Type::ptnthtm: return write_or_refuse(fields, nmea::decode_ptnthtm(sentence));
    case Type::dbt:
    case Type::dpt: return write_or_refuse(fields, nmea::decode_depth(sentence, type));
    case Type::other: return;
  }
}

}  // namespace navcal::analysis
