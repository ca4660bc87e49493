// SPDX-License-Identifier: Apache-2.0
#include "protocols/nmea_position.h"

#include <algorithm>
#include <string_view>

#include "protocols/nmea_fields.h"

namespace navcal::protocols::nmea {
namespace {

constexpr double kMaxAge_s = 1e6;
constexpr double kMaxDop = 1e4;
constexpr double kMaxHeight_m = 1e6;
constexpr double kMaxSpeed = 1e5;  // knots or km/h; satellites carry receivers too

// A says the data are valid, V that they are not; empty counts as not.
bool validity(FieldReader& fields) {
  const char status = fields.letter();
  if (status != 'A' && status != 'V' && status != '\0') fields.refuse();
  return status == 'A';
}

std::optional<Date> ddmmyy(FieldReader& fields) {
  const std::string_view text = fields.text();
  if (text.empty()) return std::nullopt;
  const auto number = parse_decimal(text);
  if (text.size() != 6 || !number || number->decimals != 0 || number->mantissa < 0) {
    fields.refuse();
    return std::nullopt;
  }
  const auto value = static_cast<unsigned>(number->mantissa);
  const Date date{full_year(value % 100), static_cast<std::uint8_t>(value / 100 % 100),
                  static_cast<std::uint8_t>(value / 10000)};
  if (!is_valid(date)) fields.refuse();
  return date;
}

/// The mode of GNS has a letter for each system of satellites.
std::uint8_t best_quality(FieldReader& fields) {
  constexpr std::string_view kModes = "NESMADPFR";  // the best last
  constexpr std::uint8_t kQualities[] = {0, 6, 8, 7, 1, 2, 3, 5, 4};
  std::size_t best = 0;
  for (const char mode : fields.text()) best = std::max(best, kModes.find(mode));
  if (best < kModes.size()) return kQualities[best];
  fields.refuse();
  return 0;
}

std::optional<Gga> position_fix(const Sentence& sentence, bool is_gns) {
  FieldReader fields(sentence);
  const auto skip_unit = [&] { fields.skip(is_gns ? 0 : 1); };
  Gga out;
  out.time = fields.time_of_day();
  out.place = fields.lat_lon();
  out.quality = is_gns ? best_quality(fields) : fields.count<std::uint8_t>().value_or(0);
  out.satellites = fields.count<std::uint8_t>();
  out.hdop = fields.decimal(0, kMaxDop);
  out.altitude_m = fields.decimal(-kMaxHeight_m, kMaxHeight_m);
  skip_unit();
  out.geoid_separation_m = fields.decimal(-kMaxHeight_m, kMaxHeight_m);
  skip_unit();
  out.correction_age_s = fields.decimal(0, kMaxAge_s);
  out.station = fields.count<std::uint16_t>();
  return fields.if_in_range(out);
}

Fix horizontal_fix(bool valid, std::optional<char> mode) {
  if (!valid || mode == 'N') return Fix::none;
  return mode == 'E' ? Fix::propagated : Fix::fix_2d;
}

}  // namespace

Fix Gga::fix() const {
  if (quality == 0 || !place) return Fix::none;
  if (quality == 6) return Fix::propagated;
  return altitude_m && (!satellites || *satellites >= 4) ? Fix::fix_3d : Fix::fix_2d;
}

Fix Rmc::fix() const { return horizontal_fix(valid && place, mode); }
Fix Gll::fix() const { return horizontal_fix(valid && place, mode); }

std::optional<Gga> decode_gga(const Sentence& sentence) { return position_fix(sentence, false); }
std::optional<Gga> decode_gns(const Sentence& sentence) { return position_fix(sentence, true); }

std::optional<Rmc> decode_rmc(const Sentence& sentence) {
  FieldReader fields(sentence);
  Rmc out;
  out.time = fields.time_of_day();
  out.valid = validity(fields);
  out.place = fields.lat_lon();
  out.speed_kn = fields.decimal(0, kMaxSpeed);
  out.course_deg = fields.decimal(0, 360);
  out.date = ddmmyy(fields);
  // Some receivers leave out the letter of the variation altogether and go on with the mode: then it stands for
  // east.
  const auto variation = fields.decimal(-180, 180);
  const char side = fields.letter();
  out.variation_deg = variation;
  if (out.variation_deg && side == 'W') out.variation_deg->mantissa = -out.variation_deg->mantissa;
  out.mode = fields.optional_letter();
  if (!out.mode && side != 'E' && side != 'W' && side != '\0') out.mode = side;
  return fields.if_in_range(out);
}

std::optional<Vtg> decode_vtg(const Sentence& sentence) {
  FieldReader fields(sentence);
  Vtg out;
  out.course_true_deg = fields.decimal(0, 360);
  const char reference = fields.letter();
  if (reference == 'T' || sentence.size() > 4) {
    out.course_magnetic_deg = fields.decimal(0, 360);
    fields.skip();
    out.speed_kn = fields.decimal(0, kMaxSpeed);
    fields.skip();
    out.speed_km_h = fields.decimal(0, kMaxSpeed);
    fields.skip();
    out.mode = fields.optional_letter();
  } else {
    fields.refuse();  // the form of before 1995, without letters of unit
  }
  return fields.if_in_range(out);
}

std::optional<Gll> decode_gll(const Sentence& sentence) {
  FieldReader fields(sentence);
  Gll out;
  out.place = fields.lat_lon();
  out.time = fields.time_of_day();
  out.valid = validity(fields);
  out.mode = fields.optional_letter();
  return fields.if_in_range(out);
}

std::optional<Gsa> decode_gsa(const Sentence& sentence) {
  FieldReader fields(sentence);
  Gsa out;
  out.selection = fields.optional_letter();
  const char fix = fields.letter();
  if (fix == '2') out.fix = Fix::fix_2d;
  if (fix == '3') out.fix = Fix::fix_3d;
  for (std::size_t i = 0; i < Gsa::kSlots; ++i) {
    if (const auto number = fields.count<std::uint16_t>()) out.satellites[out.count++] = *number;
  }
  out.pdop = fields.decimal(0, kMaxDop);
  out.hdop = fields.decimal(0, kMaxDop);
  out.vdop = fields.decimal(0, kMaxDop);
  return fields.if_in_range(out);
}

std::optional<Gsv> decode_gsv(const Sentence& sentence) {
  FieldReader fields(sentence);
  Gsv out;
  out.sentences = fields.count<std::uint8_t>().value_or(0);
  out.sentence = fields.count<std::uint8_t>().value_or(0);
  out.visible = fields.count<std::uint8_t>().value_or(0);
  // Only whole groups of four: NMEA 4.1 puts a signal number behind them.
  const std::size_t groups = sentence.size() < 3 ? 0 : (sentence.size() - 3) / 4;
  for (std::size_t i = 0; i < groups && i < out.satellites.size(); ++i) {
    const auto number = fields.count<std::uint16_t>();
    Gsv::Satellite satellite{number.value_or(0), fields.count<std::uint8_t>(), fields.count<std::uint16_t>(),
                             fields.count<std::uint8_t>()};
    if (satellite.elevation_deg.value_or(0) > 90 || satellite.azimuth_deg.value_or(0) > 360) fields.refuse();
    if (number) out.satellites[out.count++] = satellite;
  }
  return fields.if_in_range(out);
}

std::optional<Zda> decode_zda(const Sentence& sentence) {
  FieldReader fields(sentence);
  Zda out;
  out.time = fields.time_of_day();
  const auto day = fields.count<std::uint8_t>();
  const auto month = fields.count<std::uint8_t>();
  const auto year = fields.count<std::uint16_t>();
  if (day && month && year) {
    out.date = Date{*year, *month, *day};
    if (!is_valid(*out.date)) fields.refuse();
  }
  const auto hours = fields.decimal(-13, 13);
  const auto minutes = fields.decimal(-59, 59);
  if (hours) {
    const double sign = hours->mantissa < 0 ? -1 : 1;
    const double part = minutes ? minutes->value() : 0;
    out.zone_min = static_cast<std::int16_t>(hours->value() * 60 + (part < 0 ? part : sign * part));
  }
  return fields.if_in_range(out);
}

}  // namespace navcal::protocols::nmea
