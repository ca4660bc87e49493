// SPDX-License-Identifier: Apache-2.0
#include "protocols/pd0.h"

#include <cassert>

#include "protocols/wire_fields.h"

namespace navcal::protocols::pd0 {
namespace {

constexpr std::uint16_t kFixedType = 0x0000, kVariableType = 0x0080, kBottomType = 0x0600;
constexpr std::size_t kHeader = 6, kFixedLength = 59, kVariableLength = 65, kBottomLength = 81;
// The least that is read; other instruments send less or more.
constexpr std::size_t kFixedLeast = 30, kVariableLeast = 28, kBottomLeast = 44;
constexpr double kCentidegree_deg = 0.01, kCentimetre_m = 0.01, kDecimetre_m = 0.1, kMillimetre_m_s = 1e-3;
constexpr double kDecapascal_Pa = 10, kCentikelvin_C = 0.01;
constexpr std::int16_t kNoVelocity = -32768;

std::uint16_t sum_of(Bytes bytes) {
  std::uint32_t sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  return static_cast<std::uint16_t>(sum);
}

template <std::integral T>
double value_at(Bytes p, std::size_t at, double step) {
  return static_cast<double>(get_le<T>(&p[at])) * step;
}
template <std::integral T>
void put_value(std::vector<std::uint8_t>& p, std::size_t at, double value, double step) {
  put_le(&p[at], saturated<T>(value / step));
}

std::optional<FixedLeader> read_fixed(Bytes p) {
  if (p.size() < kFixedLeast) return std::nullopt;
  FixedLeader fixed;
  fixed.firmware_version = p[2];
  fixed.firmware_revision = p[3];
  fixed.system = get_le<std::uint16_t>(&p[4]);
  fixed.beams = p[8];
  fixed.cells = p[9];
  fixed.axes = static_cast<Axes>(p[25] >> 3 & 3U);
  fixed.uses_tilts = (p[25] & 4U) != 0;
  fixed.allows_three_beams = (p[25] & 2U) != 0;
  fixed.maps_bins = (p[25] & 1U) != 0;
  fixed.heading_alignment_deg = value_at<std::int16_t>(p, 26, kCentidegree_deg);
  fixed.heading_bias_deg = value_at<std::int16_t>(p, 28, kCentidegree_deg);
  if (p.size() >= 32) {
    fixed.used_sensors = p[30];
    fixed.fitted_sensors = p[31];
  }
  if (p.size() >= kFixedLength) fixed.stated_beam_angle_deg = p[58];
  return fixed;
}

std::vector<std::uint8_t> write_fixed(const FixedLeader& fixed) {
  std::vector<std::uint8_t> p(kFixedLength);
  p[2] = fixed.firmware_version;
  p[3] = fixed.firmware_revision;
  put_le(&p[4], fixed.system);
  p[8] = fixed.beams;
  p[9] = fixed.cells;
  p[25] = static_cast<std::uint8_t>(static_cast<unsigned>(fixed.axes) << 3 | (fixed.uses_tilts ? 4U : 0U) |
                                    (fixed.allows_three_beams ? 2U : 0U) | (fixed.maps_bins ? 1U : 0U));
  put_value<std::int16_t>(p, 26, fixed.heading_alignment_deg, kCentidegree_deg);
  put_value<std::int16_t>(p, 28, fixed.heading_bias_deg, kCentidegree_deg);
  p[30] = fixed.used_sensors;
  p[31] = fixed.fitted_sensors;
  p[58] = fixed.stated_beam_angle_deg;
  return p;
}

std::optional<VariableLeader> read_variable(Bytes p) {
  if (p.size() < kVariableLeast) return std::nullopt;
  VariableLeader variable;
  variable.ensemble = get_le<std::uint16_t>(&p[2]) + (std::uint32_t{p[11]} << 16);
  variable.date = {full_year(p[4]), p[5], p[6]};
  variable.time = {p[7], p[8], p[9], p[10] * 10'000'000U};
  variable.self_test = get_le<std::uint16_t>(&p[12]);
  variable.speed_of_sound_m_s = value_at<std::uint16_t>(p, 14, 1);
  variable.depth_m = value_at<std::uint16_t>(p, 16, kDecimetre_m);
  variable.heading_deg = value_at<std::uint16_t>(p, 18, kCentidegree_deg);
  variable.pitch_deg = value_at<std::int16_t>(p, 20, kCentidegree_deg);
  variable.roll_deg = value_at<std::int16_t>(p, 22, kCentidegree_deg);
  variable.salinity_ppt = value_at<std::uint16_t>(p, 24, 1);
  variable.temperature_C = value_at<std::int16_t>(p, 26, kCentikelvin_C);
  if (p.size() >= 52) variable.pressure_Pa = value_at<std::int32_t>(p, 48, kDecapascal_Pa);
  return variable;
}

std::vector<std::uint8_t> write_variable(const VariableLeader& variable) {
  std::vector<std::uint8_t> p(variable.pressure_Pa ? kVariableLength : 46U);
  put_le(&p[0], kVariableType);
  put_le(&p[2], static_cast<std::uint16_t>(variable.ensemble));
  p[4] = static_cast<std::uint8_t>(variable.date.year % 100);
  p[5] = variable.date.month;
  p[6] = variable.date.day;
  p[7] = variable.time.hour;
  p[8] = variable.time.minute;
  p[9] = variable.time.second;
  p[10] = static_cast<std::uint8_t>(variable.time.nanosecond / 10'000'000U);
  p[11] = static_cast<std::uint8_t>(variable.ensemble >> 16);
  put_le(&p[12], variable.self_test);
  put_value<std::uint16_t>(p, 14, variable.speed_of_sound_m_s, 1);
  put_value<std::uint16_t>(p, 16, variable.depth_m, kDecimetre_m);
  put_value<std::uint16_t>(p, 18, variable.heading_deg, kCentidegree_deg);
  put_value<std::int16_t>(p, 20, variable.pitch_deg, kCentidegree_deg);
  put_value<std::int16_t>(p, 22, variable.roll_deg, kCentidegree_deg);
  put_value<std::uint16_t>(p, 24, variable.salinity_ppt, 1);
  put_value<std::int16_t>(p, 26, variable.temperature_C, kCentikelvin_C);
  if (variable.pressure_Pa) put_value<std::int32_t>(p, 48, *variable.pressure_Pa, kDecapascal_Pa);
  return p;
}

std::optional<double> velocity_at(Bytes p, std::size_t at) {
  if (get_le<std::int16_t>(&p[at]) == kNoVelocity) return std::nullopt;
  return value_at<std::int16_t>(p, at, kMillimetre_m_s);
}
void put_velocity(std::vector<std::uint8_t>& p, std::size_t at, const std::optional<double>& velocity_m_s) {
  const double steps = velocity_m_s ? std::max(-32767.0, *velocity_m_s / kMillimetre_m_s) : double{kNoVelocity};
  put_le(&p[at], saturated<std::int16_t>(steps));
}

std::optional<BottomTrack> read_bottom(Bytes p) {
  if (p.size() < kBottomLeast) return std::nullopt;
  BottomTrack bottom;
  for (std::size_t i = 0; i < 4; ++i) {
    std::uint32_t range = get_le<std::uint16_t>(&p[16 + 2 * i]);
    if (p.size() >= kBottomLength) range += std::uint32_t{p[77 + i]} << 16;
    if (range != 0) bottom.range_m[i] = range * kCentimetre_m;
    bottom.velocity_m_s[i] = velocity_at(p, 24 + 2 * i);
    bottom.correlation[i] = p[32 + i];
    bottom.amplitude[i] = p[36 + i];
    bottom.percent_good[i] = p[40 + i];
    if (p.size() < 70) continue;
    bottom.water_velocity_m_s[i] = velocity_at(p, 50 + 2 * i);
    bottom.water_percent_good[i] = p[66 + i];
  }
  return bottom;
}

std::vector<std::uint8_t> write_bottom(const BottomTrack& bottom) {
  std::vector<std::uint8_t> p(kBottomLength);
  put_le(&p[0], kBottomType);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto range = saturated<std::uint32_t>(bottom.range_m[i].value_or(0) / kCentimetre_m);
    put_le(&p[16 + 2 * i], static_cast<std::uint16_t>(range));
    p[77 + i] = static_cast<std::uint8_t>(range >> 16);
    put_velocity(p, 24 + 2 * i, bottom.velocity_m_s[i]);
    p[32 + i] = bottom.correlation[i];
    p[36 + i] = bottom.amplitude[i];
    p[40 + i] = bottom.percent_good[i];
    put_velocity(p, 50 + 2 * i, bottom.water_velocity_m_s[i]);
    p[66 + i] = bottom.water_percent_good[i];
  }
  return p;
}

/// Data of one type, up to the next type or the checksum.
void read_type(Bytes p, Ensemble& ensemble) {
  const auto taken = [&](auto& member, auto value) {
    member = value;
    if (!value) ++ensemble.invalid_types;
  };
  switch (get_le<std::uint16_t>(p.data())) {
    case kFixedType: return taken(ensemble.fixed, read_fixed(p));
    case kVariableType: return taken(ensemble.variable, read_variable(p));
    case kBottomType: return taken(ensemble.bottom, read_bottom(p));
    default: ++ensemble.unknown_types;
  }
}

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available > 1 && first[1] != 0x7F) return Scan::not_a_frame();
  if (available < kHeader) return Scan::incomplete(kHeader + 4 - available);
  const std::size_t length = get_le<std::uint16_t>(first + 2);  // without the checksum
  if (first[5] == 0 || length < kHeader + 4U * first[5] || length + 2 > kMaxLength) return Scan::not_a_frame();
  if (available < length + 2) return Scan::incomplete(length + 2 - available);
  if (sum_of(Bytes(first, length)) != get_le<std::uint16_t>(first + length)) return Scan::bad_checksum();
  return Scan::frame(length + 2, kEnsemble);
}

std::optional<double> FixedLeader::beam_angle_deg() const {
  constexpr std::array<double, 3> kNamed_deg{15, 20, 30};
  const std::size_t code = system >> 8 & 3U;
  if (code < kNamed_deg.size()) return kNamed_deg[code];
  if (stated_beam_angle_deg > 0 && stated_beam_angle_deg < 90) return stated_beam_angle_deg;
  return std::nullopt;
}

Ensemble decode(Bytes frame) {
  Ensemble ensemble;
  if (frame.size() < kHeader + 2) return ensemble;
  const Bytes body = frame.first(frame.size() - 2);
  const std::size_t count = body[5];
  if (kHeader + 2 * count > body.size()) return ensemble;
  const auto offset = [&](std::size_t i) -> std::size_t {
    return i < count ? get_le<std::uint16_t>(&body[kHeader + 2 * i]) : body.size();
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = offset(i), end = offset(i + 1);
    if (begin + 2 > end || end > body.size()) {
      ++ensemble.invalid_types;
    } else {
      read_type(body.subspan(begin, end - begin), ensemble);
    }
  }
  return ensemble;
}

std::vector<std::uint8_t> encode(const Ensemble& ensemble) {
  std::vector<std::vector<std::uint8_t>> types;
  if (ensemble.fixed) types.push_back(write_fixed(*ensemble.fixed));
  if (ensemble.variable) types.push_back(write_variable(*ensemble.variable));
  if (ensemble.bottom) types.push_back(write_bottom(*ensemble.bottom));
  return encode_types(types);
}

std::vector<std::uint8_t> encode_types(const std::vector<std::vector<std::uint8_t>>& types) {
  std::vector<std::uint8_t> frame(kHeader + 2 * types.size());
  frame[0] = frame[1] = 0x7F;
  frame[5] = static_cast<std::uint8_t>(types.size());
  for (std::size_t i = 0; i < types.size(); ++i) {
    put_le(&frame[kHeader + 2 * i], static_cast<std::uint16_t>(frame.size()));
    frame.insert(frame.end(), types[i].begin(), types[i].end());
  }
  assert(frame.size() + 2 <= kMaxLength);
  put_le(&frame[2], static_cast<std::uint16_t>(frame.size()));
  const std::uint16_t sum = sum_of(frame);
  frame.push_back(static_cast<std::uint8_t>(sum));
  frame.push_back(static_cast<std::uint8_t>(sum >> 8));
  return frame;
}

}  // namespace navcal::protocols::pd0
