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

/// Payload of a frame of this message, if it is long enough.
std::optional<Bytes> payload_if(Bytes frame, MessageCode code, std::size_t least) {
  if (frame.size() < kOverhead + least || get_be<MessageCode>(frame.data() + 2) != code) return std::nullopt;
  return payload_of(frame);
}

/// Reads and writes the same place of a payload with the same scale.
template <std::integral T>
double scaled(Bytes payload, std::size_t at, double step) {
  return static_cast<double>(get_le<T>(payload.data() + at)) * step;
}
template <std::integral T>
void put_scaled(std::vector<std::uint8_t>& payload, std::size_t at, double value, double step) {
  put_le(&payload[at], saturated<T>(value / step));
}

/// Time, kind of fix and place: as in HNR-PVT, where NAV-PVT has another member of `shift` bytes in between.
NavPvt time_and_place(Bytes p, std::size_t shift) {
  NavPvt pvt;
  pvt.time_of_week_ms = get_le<std::uint32_t>(&p[0]);
  pvt.date = {get_le<std::uint16_t>(&p[4]), p[6], p[7]};
  pvt.hour = p[8];
  pvt.minute = p[9];
  pvt.second = p[10];
  pvt.date_valid = (p[11] & 1U) != 0;
  pvt.time_valid = (p[11] & 2U) != 0;
  pvt.fully_resolved = (p[11] & 4U) != 0;
  p = p.subspan(shift);
  pvt.nanosecond = get_le<std::int32_t>(&p[12]);
  pvt.fix_type = p[16];
  pvt.fix_ok = (p[17] & 1U) != 0;
  pvt.longitude_deg = scaled<std::int32_t>(p, 20, kAngleStep_deg);
  pvt.latitude_deg = scaled<std::int32_t>(p, 24, kAngleStep_deg);
  pvt.height_m = scaled<std::int32_t>(p, 28, kMillimetre_m);
  pvt.height_msl_m = scaled<std::int32_t>(p, 32, kMillimetre_m);
  return pvt;
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
  const auto payload = payload_if(frame, kNavPvt, kPvtLengthOld);
  if (!payload) return std::nullopt;
  const Bytes p = *payload;
  NavPvt pvt = time_and_place(p, 4);
  pvt.time_accuracy_s = scaled<std::uint32_t>(p, 12, kNanosecond_s);
  pvt.differential = (p[21] & 2U) != 0;
  pvt.carrier_solution = p[21] >> 6;
  pvt.satellites = p[23];
  pvt.horizontal_accuracy_m = scaled<std::uint32_t>(p, 40, kMillimetre_m);
  pvt.vertical_accuracy_m = scaled<std::uint32_t>(p, 44, kMillimetre_m);
  for (std::size_t i = 0; i < 3; ++i) pvt.velocity_ned_m_s[i] = scaled<std::int32_t>(p, 48 + 4 * i, kMillimetre_m);
  pvt.ground_speed_m_s = scaled<std::int32_t>(p, 60, kMillimetre_m);
  pvt.heading_of_motion_deg = scaled<std::int32_t>(p, 64, kHeadingStep_deg);
  pvt.speed_accuracy_m_s = scaled<std::uint32_t>(p, 68, kMillimetre_m);
  pvt.heading_accuracy_deg = scaled<std::uint32_t>(p, 72, kHeadingStep_deg);
  pvt.pdop = scaled<std::uint16_t>(p, 76, kDopStep);
  pvt.position_invalid = (p[78] & 1U) != 0;
  return pvt;
}

std::vector<std::uint8_t> encode_nav_pvt(const NavPvt& pvt) {
  std::vector<std::uint8_t> p(kPvtLength);
  const auto bit = [](bool set, unsigned place) { return static_cast<std::uint8_t>(set ? 1U << place : 0U); };
  put_le(&p[0], pvt.time_of_week_ms);
  put_le(&p[4], pvt.date.year);
  p[6] = pvt.date.month;
  p[7] = pvt.date.day;
  p[8] = pvt.hour;
  p[9] = pvt.minute;
  p[10] = pvt.second;
  p[11] = bit(pvt.date_valid, 0) | bit(pvt.time_valid, 1) | bit(pvt.fully_resolved, 2);
  put_scaled<std::uint32_t>(p, 12, pvt.time_accuracy_s, kNanosecond_s);
  put_le(&p[16], pvt.nanosecond);
  p[20] = pvt.fix_type;
  p[21] = static_cast<std::uint8_t>(bit(pvt.fix_ok, 0) | bit(pvt.differential, 1) | pvt.carrier_solution << 6);
  p[23] = pvt.satellites;
  put_scaled<std::int32_t>(p, 24, pvt.longitude_deg, kAngleStep_deg);
  put_scaled<std::int32_t>(p, 28, pvt.latitude_deg, kAngleStep_deg);
  put_scaled<std::int32_t>(p, 32, pvt.height_m, kMillimetre_m);
  put_scaled<std::int32_t>(p, 36, pvt.height_msl_m, kMillimetre_m);
  put_scaled<std::uint32_t>(p, 40, pvt.horizontal_accuracy_m, kMillimetre_m);
  put_scaled<std::uint32_t>(p, 44, pvt.vertical_accuracy_m, kMillimetre_m);
  for (std::size_t i = 0; i < 3; ++i) {
    put_scaled<std::int32_t>(p, 48 + 4 * i, pvt.velocity_ned_m_s[i], kMillimetre_m);
  }
  put_scaled<std::int32_t>(p, 60, pvt.ground_speed_m_s, kMillimetre_m);
  put_scaled<std::int32_t>(p, 64, pvt.heading_of_motion_deg, kHeadingStep_deg);
  put_scaled<std::uint32_t>(p, 68, pvt.speed_accuracy_m_s, kMillimetre_m);
  put_scaled<std::uint32_t>(p, 72, pvt.heading_accuracy_deg, kHeadingStep_deg);
  put_scaled<std::uint16_t>(p, 76, pvt.pdop, kDopStep);
  p[78] = bit(pvt.position_invalid, 0);
  return encode_frame(kNavPvt, p);
}

std::optional<NavPvt> decode_hnr_pvt(Bytes frame) {
  const auto payload = payload_if(frame, kHnrPvt, kHnrPvtLength);
  if (!payload) return std::nullopt;
  NavPvt pvt = time_and_place(*payload, 0);
  pvt.ground_speed_m_s = scaled<std::int32_t>(*payload, 36, kMillimetre_m);
  pvt.heading_of_motion_deg = scaled<std::int32_t>(*payload, 44, kHeadingStep_deg);
  pvt.horizontal_accuracy_m = scaled<std::uint32_t>(*payload, 52, kMillimetre_m);
  pvt.vertical_accuracy_m = scaled<std::uint32_t>(*payload, 56, kMillimetre_m);
  pvt.speed_accuracy_m_s = scaled<std::uint32_t>(*payload, 60, kMillimetre_m);
  return pvt;
}

std::optional<NavAttitude> decode_attitude(Bytes frame) {
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
  const auto payload = payload_if(frame, kNavTimeGps, kTimeGpsLength);
  if (!payload) return std::nullopt;
  const Bytes p = *payload;
  return NavTimeGps{get_le<std::uint32_t>(&p[0]),
                    get_le<std::int32_t>(&p[4]),
                    get_le<std::int16_t>(&p[8]),
                    static_cast<std::int8_t>(p[10]),
                    (p[11] & 1U) != 0,
                    (p[11] & 2U) != 0,
                    (p[11] & 4U) != 0,
                    scaled<std::uint32_t>(p, 12, kNanosecond_s)};
}

std::vector<std::uint8_t> encode_nav_timegps(const NavTimeGps& time) {
  std::vector<std::uint8_t> p(kTimeGpsLength);
  put_le(&p[0], time.time_of_week_ms);
  put_le(&p[4], time.fraction_ns);
  put_le(&p[8], time.week);
  put_le(&p[10], time.leap_s);
  p[11] = static_cast<std::uint8_t>((time.time_of_week_valid ? 1U : 0U) | (time.week_valid ? 2U : 0U) |
                                    (time.leap_valid ? 4U : 0U));
  put_scaled<std::uint32_t>(p, 12, time.time_accuracy_s, kNanosecond_s);
  return encode_frame(kNavTimeGps, p);
}

std::optional<NavDop> decode_nav_dop(Bytes frame) {
  const auto payload = payload_if(frame, kNavDop, kDopLength);
  if (!payload) return std::nullopt;
  const auto dop = [&](std::size_t at) { return scaled<std::uint16_t>(*payload, at, kDopStep); };
  return NavDop{
      get_le<std::uint32_t>(payload->data()), dop(4), dop(6), dop(8), dop(10), dop(12), dop(14), dop(16)};
}

std::vector<std::uint8_t> encode_nav_dop(const NavDop& dop) {
  std::vector<std::uint8_t> p(kDopLength);
  put_le(&p[0], dop.time_of_week_ms);
  std::size_t at = 4;
  for (const double value :
       {dop.geometric, dop.position, dop.time, dop.vertical, dop.horizontal, dop.northing, dop.easting}) {
    put_scaled<std::uint16_t>(p, at, value, kDopStep);
    at += 2;
  }
  return encode_frame(kNavDop, p);
}

std::optional<NavSat> decode_nav_sat(Bytes frame) {
  const auto payload = payload_if(frame, kNavSat, kSatHeader);
  if (!payload || payload->size() < kSatHeader + kSatSlot * (*payload)[5]) return std::nullopt;
  NavSat sat;
  sat.time_of_week_ms = get_le<std::uint32_t>(payload->data());
  sat.count = (*payload)[5];
  for (std::size_t i = 0; i < sat.count; ++i) {
    const Bytes p = payload->subspan(kSatHeader + kSatSlot * i, kSatSlot);
    const auto flags = get_le<std::uint32_t>(&p[8]);
    sat.satellites[i] = {p[0],
                         p[1],
                         p[2],
                         static_cast<std::int8_t>(p[3]),
                         get_le<std::int16_t>(&p[4]),
                         scaled<std::int16_t>(p, 6, kResidualStep_m),
                         static_cast<std::uint8_t>(flags & 7U),
                         (flags & 8U) != 0,
                         static_cast<std::uint8_t>(flags >> 4 & 3U),
                         flags};
  }
  return sat;
}

std::vector<std::uint8_t> encode_nav_sat(const NavSat& satellites) {
  const std::size_t count = std::min(satellites.count, NavSat::kSlots);
  std::vector<std::uint8_t> p(kSatHeader);
  put_le(&p[0], satellites.time_of_week_ms);
  p[4] = 1;  // version of the message
  p[5] = static_cast<std::uint8_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const NavSat::Satellite& one = satellites.satellites[i];
    std::vector<std::uint8_t> slot(kSatSlot);
    slot[0] = one.gnss;
    slot[1] = one.number;
    slot[2] = one.cn0_dBHz;
    put_le(&slot[3], one.elevation_deg);
    put_le(&slot[4], one.azimuth_deg);
    put_scaled<std::int16_t>(slot, 6, one.residual_m, kResidualStep_m);
    const std::uint32_t low = (one.quality & 7U) | (one.used ? 8U : 0U) | (one.health & 3U) << 4;
    put_le(&slot[8], (one.flags & ~std::uint32_t{0x3F}) | low);
    p.insert(p.end(), slot.begin(), slot.end());
  }
  return encode_frame(kNavSat, p);
}

}  // namespace navcal::protocols::ubx
