// SPDX-License-Identifier: Apache-2.0
#include "protocols/pd0.h"

#include <cassert>

#include "protocols/described/checksum.h"
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
  return static_cast<std::uint16_t>(described::sum_of(described::Sum::sum16, bytes));
}

template <class Layout, class Leader>
void lay_out_fixed(const Layout& p, Leader& fixed) {
  p.number(2, fixed.firmware_version);
  p.number(3, fixed.firmware_revision);
  p.number(4, fixed.system);
  p.number(8, fixed.beams);
  p.number(9, fixed.cells);
  p.bits(25, 3, 2, fixed.axes);
  p.bits(25, 2, 1, fixed.uses_tilts);
  p.bits(25, 1, 1, fixed.allows_three_beams);
  p.bits(25, 0, 1, fixed.maps_bins);
  p.template scaled<std::int16_t>(26, fixed.heading_alignment_deg, kCentidegree_deg);
  p.template scaled<std::int16_t>(28, fixed.heading_bias_deg, kCentidegree_deg);
  if (p.size() >= 32) {
    p.number(30, fixed.used_sensors);
    p.number(31, fixed.fitted_sensors);
  }
  if (p.size() >= kFixedLength) p.number(58, fixed.stated_beam_angle_deg);
}

std::optional<FixedLeader> read_fixed(Bytes p) {
  if (p.size() < kFixedLeast) return std::nullopt;
  FixedLeader fixed;
  lay_out_fixed(LayoutReader(p), fixed);
  return fixed;
}

std::vector<std::uint8_t> write_fixed(const FixedLeader& fixed) {
  std::vector<std::uint8_t> p(kFixedLength);
  lay_out_fixed(LayoutWriter(p), fixed);
  return p;
}

/// But for ensemble, year, hundredths of a second and pressure.
template <class Layout, class Leader>
void lay_out_variable(const Layout& p, Leader& variable) {
  p.number(5, variable.date.month);
  p.number(6, variable.date.day);
  p.number(7, variable.time.hour);
  p.number(8, variable.time.minute);
  p.number(9, variable.time.second);
  p.number(12, variable.self_test);
  p.template scaled<std::uint16_t>(14, variable.speed_of_sound_m_s, 1);
  p.template scaled<std::uint16_t>(16, variable.depth_m, kDecimetre_m);
  p.template scaled<std::uint16_t>(18, variable.heading_deg, kCentidegree_deg);
  p.template scaled<std::int16_t>(20, variable.pitch_deg, kCentidegree_deg);
  p.template scaled<std::int16_t>(22, variable.roll_deg, kCentidegree_deg);
  p.template scaled<std::uint16_t>(24, variable.salinity_ppt, 1);
  p.template scaled<std::int16_t>(26, variable.temperature_C, kCentikelvin_C);
}

std::optional<VariableLeader> read_variable(Bytes p) {
  if (p.size() < kVariableLeast) return std::nullopt;
  VariableLeader variable;
  lay_out_variable(LayoutReader(p), variable);
  variable.ensemble = get_le<std::uint16_t>(&p[2]) + (std::uint32_t{p[11]} << 16);
  variable.date.year = full_year(p[4]);
  variable.time.nanosecond = p[10] * 10'000'000U;
  if (p.size() >= 52) LayoutReader(p).scaled<std::int32_t>(48, variable.pressure_Pa.emplace(), kDecapascal_Pa);
  return variable;
}

std::vector<std::uint8_t> write_variable(const VariableLeader& variable) {
  std::vector<std::uint8_t> p(variable.pressure_Pa ? kVariableLength : 46U);
  lay_out_variable(LayoutWriter(p), variable);
  put_le(&p[0], kVariableType);
  put_le(&p[2], static_cast<std::uint16_t>(variable.ensemble));
  p[4] = static_cast<std::uint8_t>(variable.date.year % 100);
  p[10] = static_cast<std::uint8_t>(variable.time.nanosecond / 10'000'000U);
  p[11] = static_cast<std::uint8_t>(variable.ensemble >> 16);
  if (variable.pressure_Pa) LayoutWriter(p).scaled<std::int32_t>(48, *variable.pressure_Pa, kDecapascal_Pa);
  return p;
}

void velocity(const LayoutReader& p, std::size_t at, std::optional<double>& velocity_m_s) {
  std::int16_t steps = 0;
  p.number(at, steps);
  if (steps != kNoVelocity) velocity_m_s = steps * kMillimetre_m_s;
}
void velocity(const LayoutWriter& p, std::size_t at, const std::optional<double>& velocity_m_s) {
  const double steps = velocity_m_s ? std::max(-32767.0, *velocity_m_s / kMillimetre_m_s) : double{kNoVelocity};
  p.number(at, saturated<std::int16_t>(steps));
}

/// But for the ranges.
template <class Layout, class Track>
void lay_out_beam(const Layout& p, Track& bottom, std::size_t i) {
  velocity(p, 24 + 2 * i, bottom.velocity_m_s[i]);
  p.number(32 + i, bottom.correlation[i]);
  p.number(36 + i, bottom.amplitude[i]);
  p.number(40 + i, bottom.percent_good[i]);
  if (p.size() < 70) return;
  velocity(p, 50 + 2 * i, bottom.water_velocity_m_s[i]);
  p.number(66 + i, bottom.water_percent_good[i]);
}

std::optional<BottomTrack> read_bottom(Bytes p) {
  if (p.size() < kBottomLeast) return std::nullopt;
  BottomTrack bottom;
  for (std::size_t i = 0; i < 4; ++i) {
    std::uint32_t range = get_le<std::uint16_t>(&p[16 + 2 * i]);
    if (p.size() >= kBottomLength) range += std::uint32_t{p[77 + i]} << 16;
    if (range != 0) bottom.range_m[i] = range * kCentimetre_m;
    lay_out_beam(LayoutReader(p), bottom, i);
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
    lay_out_beam(LayoutWriter(p), bottom, i);
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
  if (first[5] == 0 || length < kHeader + 4UL * first[5] || length + 2 > kMaxLength) return Scan::not_a_frame();
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
  append_le(frame, sum_of(frame));
  return frame;
}

}  // namespace navcal::protocols::pd0
