// SPDX-License-Identifier: Apache-2.0
#include "protocols/ubx_navigation.h"

#include <algorithm>

#include "protocols/wire_fields.h"

namespace navcal::protocols::ubx {
namespace {

constexpr double kAngleStep_deg = 1e-7, kHeadingStep_deg = 1e-5, kMillimetre_m = 1e-3, kNanosecond_s = 1e-9;
constexpr double kDopStep = 0.01, kResidualStep_m = 0.1;
// GPS time begins in 1980; nanoseconds since 1970 in 64 bits end in 2262.
constexpr std::uint16_t kFirstPvtYear = 1980, kLastPvtYear = 2261;
constexpr std::size_t kPvtLength = 92, kPvtLengthOld = 84;  // the old one is that of generation 7
constexpr std::size_t kHnrPvtLength = 72, kAttitudeLength = 32, kRelPosLength = 64, kRelPosLengthOld = 40;
constexpr std::size_t kTimeGpsLength = 16, kDopLength = 18, kSatHeader = 8, kSatSlot = 12;

template <std::integral T>
double scaled(Bytes payload, std::size_t at, double step) {
  return static_cast<double>(get_le<T>(payload.data() + at)) * step;
}

/// Time, kind of fix and place: as in HNR-PVT, where NAV-PVT has another member of `shift` bytes in between.
template <class Layout, class Pvt>
void lay_out_time_and_place(const Layout& p, Pvt& pvt, std::size_t shift) {
  p.number(0, pvt.time_of_week_ms);
  p.number(4, pvt.date.year);
  p.number(6, pvt.date.month);
  p.number(7, pvt.date.day);
  p.number(8, pvt.hour);
  p.number(9, pvt.minute);
  p.number(10, pvt.second);
  p.bits(11, 0, 1, pvt.date_valid);
  p.bits(11, 1, 1, pvt.time_valid);
  p.bits(11, 2, 1, pvt.fully_resolved);
  p.number(shift + 12, pvt.nanosecond);
  p.number(shift + 16, pvt.fix_type);
  p.bits(shift + 17, 0, 1, pvt.fix_ok);
  p.template scaled<std::int32_t>(shift + 20, pvt.longitude_deg, kAngleStep_deg);
  p.template scaled<std::int32_t>(shift + 24, pvt.latitude_deg, kAngleStep_deg);
  p.template scaled<std::int32_t>(shift + 28, pvt.height_m, kMillimetre_m);
  p.template scaled<std::int32_t>(shift + 32, pvt.height_msl_m, kMillimetre_m);
}

constexpr auto kLayOutPvt = [](const auto& p, auto& pvt) {
  lay_out_time_and_place(p, pvt, 4);
  p.template scaled<std::uint32_t>(12, pvt.time_accuracy_s, kNanosecond_s);
  p.bits(21, 1, 1, pvt.differential);
  p.bits(21, 6, 2, pvt.carrier_solution);
  p.number(23, pvt.satellites);
  p.template scaled<std::uint32_t>(40, pvt.horizontal_accuracy_m, kMillimetre_m);
  p.template scaled<std::uint32_t>(44, pvt.vertical_accuracy_m, kMillimetre_m);
  for (std::size_t i = 0; i < 3; ++i)
    p.template scaled<std::int32_t>(48 + 4 * i, pvt.velocity_ned_m_s[i], kMillimetre_m);
  p.template scaled<std::int32_t>(60, pvt.ground_speed_m_s, kMillimetre_m);
  p.template scaled<std::int32_t>(64, pvt.heading_of_motion_deg, kHeadingStep_deg);
  p.template scaled<std::uint32_t>(68, pvt.speed_accuracy_m_s, kMillimetre_m);
  p.template scaled<std::uint32_t>(72, pvt.heading_accuracy_deg, kHeadingStep_deg);
  p.template scaled<std::uint16_t>(76, pvt.pdop, kDopStep);
  p.bits(78, 0, 1, pvt.position_invalid);
};

constexpr auto kLayOutTimeGps = [](const auto& p, auto& time) {
  p.number(0, time.time_of_week_ms);
  p.number(4, time.fraction_ns);
  p.number(8, time.week);
  p.number(10, time.leap_s);
  p.bits(11, 0, 1, time.time_of_week_valid);
  p.bits(11, 1, 1, time.week_valid);
  p.bits(11, 2, 1, time.leap_valid);
  p.template scaled<std::uint32_t>(12, time.time_accuracy_s, kNanosecond_s);
};

constexpr auto kLayOutDop = [](const auto& p, auto& dop) {
  p.number(0, dop.time_of_week_ms);
  std::size_t at = 4;
  for (auto* const value :
       {&dop.geometric, &dop.position, &dop.time, &dop.vertical, &dop.horizontal, &dop.northing, &dop.easting}) {
    p.template scaled<std::uint16_t>(at, *value, kDopStep);
    at += 2;
  }
};

template <class Layout, class Satellite>
void lay_out_satellite(const Layout& p, std::size_t at, Satellite& one) {
  p.number(at, one.gnss);
  p.number(at + 1, one.number);
  p.number(at + 2, one.cn0_dBHz);
  p.number(at + 3, one.elevation_deg);
  p.number(at + 4, one.azimuth_deg);
  p.template scaled<std::int16_t>(at + 6, one.residual_m, kResidualStep_m);
  p.number(at + 8, one.flags);
  p.bits(at + 8, 0, 3, one.quality);
  p.bits(at + 8, 3, 1, one.used);
  p.bits(at + 8, 4, 2, one.health);
}

/// A message whose fields `lay_out(layout, message)` places, from a frame.
template <class Message, class LayOut>
std::optional<Message> decoded(Bytes frame, MessageCode code, std::size_t least, LayOut lay_out) {
  const auto payload = payload_if(frame, code, least);
  if (!payload) return std::nullopt;
  Message message;
  lay_out(LayoutReader(*payload), message);
  return message;
}

template <class Message, class LayOut>
std::vector<std::uint8_t> encoded(const Message& message, MessageCode code, std::size_t length, LayOut lay_out) {
  std::vector<std::uint8_t> payload(length);
  lay_out(LayoutWriter(payload), message);
  return encode_frame(code, payload);
}

}  // namespace

std::optional<std::int64_t> NavPvt::utc_ns() const {
  const TimeOfDay time{hour, minute, second, 0};
  if (!date_valid || !time_valid || !is_valid(date) || !is_valid(time)) return std::nullopt;
  if (date.year < kFirstPvtYear || date.year > kLastPvtYear) return std::nullopt;
  return unix_ns(date, time) + nanosecond;
}

Fix NavPvt::fix() const {
  if (!fix_ok || position_invalid) return Fix::none;
  switch (fix_type) {
    case 1: return Fix::propagated;
    case 2: return Fix::fix_2d;
    case 3:
    case 4: return Fix::fix_3d;
    default: return Fix::none;
  }
}

std::optional<NavPvt> decode_nav_pvt(Bytes frame) {
  return decoded<NavPvt>(frame, kNavPvt, kPvtLengthOld, kLayOutPvt);
}

std::vector<std::uint8_t> encode_nav_pvt(const NavPvt& pvt) {
  return encoded(pvt, kNavPvt, kPvtLength, kLayOutPvt);
}

std::optional<NavPvt> decode_hnr_pvt(Bytes frame) {
  const auto payload = payload_if(frame, kHnrPvt, kHnrPvtLength);
  if (!payload) return std::nullopt;
  NavPvt pvt;
  lay_out_time_and_place(LayoutReader(*payload), pvt, 0);
  pvt.ground_speed_m_s = scaled<std::int32_t>(*payload, 36, kMillimetre_m);
  pvt.heading_of_motion_deg = scaled<std::int32_t>(*payload, 44, kHeadingStep_deg);
  pvt.horizontal_accuracy_m = scaled<std::uint32_t>(*payload, 52, kMillimetre_m);
  pvt.vertical_accuracy_m = scaled<std::uint32_t>(*payload, 56, kMillimetre_m);
  pvt.speed_accuracy_m_s = scaled<std::uint32_t>(*payload, 60, kMillimetre_m);
  return pvt;
}

std::optional<NavAttitude> decode_attitude(Bytes frame) {
  if (frame.size() < kOverhead) return std::nullopt;
  const auto payload = payload_if(frame, get_be<MessageCode>(frame.data() + 2), kAttitudeLength);
  if (!payload) return std::nullopt;
  NavAttitude attitude;
  for (std::size_t i = 0; i < 3; ++i) {
    attitude.angles_deg[i] = scaled<std::int32_t>(*payload, 8 + 4 * i, kHeadingStep_deg);
    attitude.accuracies_deg[i] = scaled<std::uint32_t>(*payload, 20 + 4 * i, kHeadingStep_deg);
  }
  return attitude;
}

std::optional<RelativePosition> decode_nav_relposned(Bytes frame) {
  constexpr double kCentimetre_m = 1e-2, kFine_m = 1e-4;
  const auto payload = payload_if(frame, kNavRelPosNed, kRelPosLengthOld);
  const bool is_old = payload && (*payload)[0] == 0;
  if (!payload || (!is_old && payload->size() < kRelPosLength)) return std::nullopt;
  const Bytes p = *payload;
  RelativePosition relative;
  for (std::size_t i = 0; i < 3; ++i) {
    relative.position_ned_m[i] = scaled<std::int32_t>(p, 8 + 4 * i, kCentimetre_m) +
                                 scaled<std::int8_t>(p, (is_old ? 20 : 32) + i, kFine_m);
    relative.accuracies_m[i] = scaled<std::uint32_t>(p, (is_old ? 24 : 36) + 4 * i, kFine_m);
  }
  constexpr std::uint32_t kValid = 1 | 4, kHeadingValid = 0x100, kNormalized = 0x200;
  const auto flags = get_le<std::uint32_t>(&p[is_old ? 36 : 60]);
  relative.position_valid = (flags & (kValid | kNormalized)) == kValid;
  if (is_old || (flags & (kValid | kHeadingValid)) != (kValid | kHeadingValid)) return relative;
  relative.line.angles_deg[2] = scaled<std::int32_t>(p, 24, kHeadingStep_deg);
  relative.line.accuracies_deg[2] = scaled<std::uint32_t>(p, 52, kHeadingStep_deg);
  return relative;
}

std::optional<NavTimeGps> decode_nav_timegps(Bytes frame) {
  return decoded<NavTimeGps>(frame, kNavTimeGps, kTimeGpsLength, kLayOutTimeGps);
}

std::vector<std::uint8_t> encode_nav_timegps(const NavTimeGps& time) {
  return encoded(time, kNavTimeGps, kTimeGpsLength, kLayOutTimeGps);
}

std::optional<NavDop> decode_nav_dop(Bytes frame) {
  return decoded<NavDop>(frame, kNavDop, kDopLength, kLayOutDop);
}

std::vector<std::uint8_t> encode_nav_dop(const NavDop& dop) {
  return encoded(dop, kNavDop, kDopLength, kLayOutDop);
}

std::optional<NavSat> decode_nav_sat(Bytes frame) {
  const auto payload = payload_if(frame, kNavSat, kSatHeader);
  if (!payload || payload->size() < kSatHeader + kSatSlot * (*payload)[5]) return std::nullopt;
  NavSat sat;
  sat.time_of_week_ms = get_le<std::uint32_t>(payload->data());
  sat.count = (*payload)[5];
  for (std::size_t i = 0; i < sat.count; ++i)
    lay_out_satellite(LayoutReader(*payload), kSatHeader + kSatSlot * i, sat.satellites[i]);
  return sat;
}

std::vector<std::uint8_t> encode_nav_sat(const NavSat& satellites) {
  const std::size_t count = std::min(satellites.count, NavSat::kSlots);
  std::vector<std::uint8_t> payload(kSatHeader + kSatSlot * count);
  put_le(&payload[0], satellites.time_of_week_ms);
  payload[4] = 1;  // version of the message
  payload[5] = static_cast<std::uint8_t>(count);
  for (std::size_t i = 0; i < count; ++i)
    lay_out_satellite(LayoutWriter(payload), kSatHeader + kSatSlot * i, satellites.satellites[i]);
  return encode_frame(kNavSat, payload);
}

}  // namespace navcal::protocols::ubx
