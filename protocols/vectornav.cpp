// SPDX-License-Identifier: Apache-2.0
#include "protocols/vectornav.h"

#include <algorithm>
#include <bit>
#include <string_view>

#include "protocols/checked_line.h"
#include "protocols/crc16.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::vectornav {
namespace {

constexpr double kVnGauss_uT = 100, kKilopascal_Pa = 1000;
constexpr std::size_t kMaxLine = 256;

/// Bytes of each field of the groups 1 to 7: common, time, IMU, GNSS, attitude, INS, GNSS 2. 0: not known here.
constexpr std::array<std::array<std::uint8_t, 16>, 7> kFieldSizes{{
    {8, 8, 8, 12, 16, 12, 24, 12, 12, 24, 20, 28, 2, 4, 8, 0},
    {8, 8, 8, 2, 8, 8, 8, 4, 4, 1, 0, 0, 0, 0, 0, 0},
    {2, 12, 12, 12, 4, 4, 16, 12, 12, 12, 12, 2, 0, 0, 0, 0},
    {8, 8, 2, 1, 1, 24, 24, 12, 12, 12, 4, 4, 2, 28, 0, 0},
    {2, 12, 16, 36, 12, 12, 12, 12, 12, 0, 0, 0, 0, 0, 0, 0},
    {2, 24, 24, 12, 12, 12, 12, 12, 12, 4, 4, 0, 0, 0, 0, 0},
    {8, 8, 2, 1, 1, 24, 24, 12, 12, 12, 4, 4, 2, 28, 0, 0},
}};

constexpr std::size_t kAttitudeGroup = 4;
constexpr unsigned kAttitudeStd = 8;  // its field of standard deviations

/// Bits of the common group.
enum Common : unsigned {
  time_startup,
  time_gps,
  time_sync_in,
  yaw_pitch_roll,
  quaternion_field,
  angular_rate,
  position_field,
  velocity_field,
  acceleration_field,
  imu_field,
  field_and_pressure,
};

template <class T>
Triple triple(const std::uint8_t* p, double unit = 1) {
  return {double{get_le<T>(p)} * unit, double{get_le<T>(p + sizeof(T))} * unit,
          double{get_le<T>(p + 2 * sizeof(T))} * unit};
}

/// A field of the common group; false for one that is left.
bool read_common(unsigned bit, const std::uint8_t* p, Reading& reading) {
  switch (bit) {
    case time_startup: reading.since_startup_ns = get_le<std::uint64_t>(p); return true;
    case time_gps: reading.gps_time_ns = get_le<std::uint64_t>(p); return true;
    case yaw_pitch_roll: reading.yaw_pitch_roll_deg = triple<float>(p); return true;
    case quaternion_field: {
      const Triple vector = triple<float>(p);
      reading.quaternion = {vector[0], vector[1], vector[2], double{get_le<float>(p + 12)}};
      return true;
    }
    case angular_rate: reading.rate_rad_s = triple<float>(p); return true;
    case position_field: reading.position = triple<double>(p); return true;
    case velocity_field: reading.velocity_ned_m_s = triple<float>(p); return true;
    case acceleration_field: reading.acceleration_m_s2 = triple<float>(p); return true;
    case imu_field:
      reading.raw_acceleration_m_s2 = triple<float>(p);
      reading.raw_rate_rad_s = triple<float>(p + 12);
      return true;
    case field_and_pressure:
      reading.field_uT = triple<float>(p, kVnGauss_uT);
      reading.temperature_C = double{get_le<float>(p + 12)};
      reading.pressure_Pa = double{get_le<float>(p + 16)} * kKilopascal_Pa;
      return true;
    default: return false;
  }
}

/// A field of the IMU group.
bool read_imu(unsigned bit, const std::uint8_t* p, Reading& reading) {
  switch (bit) {
    case 1: reading.raw_field_uT = triple<float>(p, kVnGauss_uT); return true;
    case 2: reading.raw_acceleration_m_s2 = triple<float>(p); return true;
    case 3: reading.raw_rate_rad_s = triple<float>(p); return true;
    case 4: reading.temperature_C = double{get_le<float>(p)}; return true;
    case 5: reading.pressure_Pa = double{get_le<float>(p)} * kKilopascal_Pa; return true;
    case 8: reading.field_uT = triple<float>(p, kVnGauss_uT); return true;
    case 9: reading.acceleration_m_s2 = triple<float>(p); return true;
    case 10: reading.rate_rad_s = triple<float>(p); return true;
    default: return false;
  }
}

/// A field of a group, counted from 0.
bool read_field(std::size_t group, unsigned bit, const std::uint8_t* p, Reading& reading) {
  switch (group) {
    case 0: return read_common(bit, p, reading);
    case 1:  // time: since start-up, GPS
      return bit <= 1 && read_common(bit == 0 ? time_startup : time_gps, p, reading);
    case 2: return read_imu(bit, p, reading);
    case kAttitudeGroup:
      if (bit == 1) return read_common(yaw_pitch_roll, p, reading);
      if (bit == 2) return read_common(quaternion_field, p, reading);
      if (bit != kAttitudeStd) return false;
      reading.yaw_pitch_roll_std_deg = triple<float>(p);
      return true;
    default: return false;
  }
}

/// Calls visit(group, bit) for each field that the field words of a message announce, in their order.
template <class Visit>
void each_field(const std::uint8_t* first, Visit visit) {
  const std::uint8_t* word = first + 2;
  for (std::size_t group = 0; group < kFieldSizes.size(); ++group) {
    if ((first[1] >> group & 1U) == 0) continue;
    const unsigned fields = get_le<std::uint16_t>(word);
    word += 2;
    for (unsigned bit = 0; bit < 16; ++bit) {
      if ((fields >> bit & 1U) != 0) visit(group, bit);
    }
  }
}

/// Bytes from the sync to the checksum, once all field words are there; 0 for a field without a known size.
std::size_t binary_length(const std::uint8_t* first) {
  std::size_t length = 4 + 2 * static_cast<std::size_t>(std::popcount(first[1]));
  bool is_known = true;
  each_field(first, [&](std::size_t group, unsigned bit) {
    is_known = is_known && kFieldSizes[group][bit] != 0;
    length += kFieldSizes[group][bit];
  });
  return is_known ? length : 0;
}

Scan scan_binary(const std::uint8_t* first, std::size_t available) {
  if (available < 2) return Scan::incomplete(1);
  // The eighth bit would announce a second group byte, which is not read here.
  if (first[1] == 0 || first[1] > 0x7F) return Scan::not_a_frame();
  const std::size_t head = 2 + 2 * static_cast<std::size_t>(std::popcount(first[1]));
  if (available < head) return Scan::incomplete(head - available);
  const std::size_t length = binary_length(first);
  if (length == 0 || length > Scanner::kMaxFrameLength) return Scan::not_a_frame();
  if (available < length) return Scan::incomplete(length - available);
  const bool intact = crc16_xmodem(Bytes(first + 1, length - 3)) == get_be<std::uint16_t>(first + length - 2);
  return intact ? Scan::frame(length, kBinary) : Scan::bad_checksum();
}

template <class T>
void append_numbers(std::vector<std::uint8_t>& fields, const Triple& values, double unit = 1) {
  for (const double value : values) append_le(fields, static_cast<T>(value / unit));
}

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (*first == 0xFA) return scan_binary(first, available);
  constexpr std::string_view kStart = "$VN";
  if (!std::equal(first, first + std::min(available, kStart.size()), kStart.begin())) return Scan::not_a_frame();
  if (available < 6) return Scan::incomplete(6 - available);
  return scan_checked_line(first, last, kMaxLine,
                           FrameId(std::string_view(reinterpret_cast<const char*>(first) + 1, 5)));
}

std::optional<Reading> decode_binary(Bytes frame) {
  if (frame.size() < 4 || frame[0] != 0xFA) return std::nullopt;
  Reading reading;
  const std::uint8_t* field = &frame[2] + 2 * static_cast<std::size_t>(std::popcount(frame[1]));
  each_field(frame.data(), [&](std::size_t group, unsigned bit) {
    if (!read_field(group, bit, field, reading)) ++reading.unknown_fields;
    field += kFieldSizes[group][bit];
  });
  return reading;
}

std::vector<std::uint8_t> encode_binary(const Reading& reading) {
  std::vector<std::uint8_t> fields;
  unsigned bits = 0;
  const auto append_time = [&](Common bit, const std::optional<std::uint64_t>& time_ns) {
    if (!time_ns) return;
    bits |= 1U << bit;
    append_le(fields, *time_ns);
  };
  const auto append_triple = [&](Common bit, const std::optional<Triple>& values) {
    if (!values) return;
    bits |= 1U << bit;
    append_numbers<float>(fields, *values);
  };
  append_time(time_startup, reading.since_startup_ns);
  append_time(time_gps, reading.gps_time_ns);
  append_triple(yaw_pitch_roll, reading.yaw_pitch_roll_deg);
  if (const auto& q = reading.quaternion) {
    append_triple(quaternion_field, Triple{(*q)[0], (*q)[1], (*q)[2]});
    append_le(fields, static_cast<float>((*q)[3]));
  }
  append_triple(angular_rate, reading.rate_rad_s);
  if (reading.position) {
    bits |= 1U << position_field;
    append_numbers<double>(fields, *reading.position);
  }
  append_triple(velocity_field, reading.velocity_ned_m_s);
  append_triple(acceleration_field, reading.acceleration_m_s2);
  if (reading.raw_acceleration_m_s2) {
    append_triple(imu_field, reading.raw_acceleration_m_s2);
    append_numbers<float>(fields, reading.raw_rate_rad_s.value_or(Triple{}));
  }
  if (reading.field_uT) {
    bits |= 1U << field_and_pressure;
    append_numbers<float>(fields, *reading.field_uT, kVnGauss_uT);
    append_le(fields, static_cast<float>(reading.temperature_C.value_or(0)));
    append_le(fields, static_cast<float>(reading.pressure_Pa.value_or(0) / kKilopascal_Pa));
  }
  std::vector<std::uint8_t> frame{0xFA, 0x01, static_cast<std::uint8_t>(bits),
                                  static_cast<std::uint8_t>(bits >> 8)};
  if (reading.yaw_pitch_roll_std_deg) {
    frame[1] |= 1U << kAttitudeGroup;
    frame.push_back(0);
    frame.push_back(1U << (kAttitudeStd - 8));
    append_numbers<float>(fields, *reading.yaw_pitch_roll_std_deg);
  }
  frame.insert(frame.end(), fields.begin(), fields.end());
  append_be(frame, crc16_xmodem(Bytes(frame).subspan(1)));
  return frame;
}

}  // namespace navcal::protocols::vectornav
