// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// MicroStrain inertial sensors (3DM-CV5, -GX5, -CV7, -GQ7). Manual, not at hand (ICD): "MIP protocol" and "Data
/// reference" of the manuals: 75 65, descriptor set, payload length, fields (length, descriptor, data; big
/// endian), Fletcher over all before it (ICD section 7).
namespace navcal::protocols::mip {

inline constexpr std::uint8_t kBaseSet = 0x01, k3dmSet = 0x0C, kSensorSet = 0x80, kFilterSet = 0x82,
                              kSystemSet = 0xA0;

/// "80": the identifier of packets of a descriptor set, its number in hexadecimal.
[[nodiscard]] FrameId id_of(std::uint8_t set);

inline constexpr std::size_t kOverhead = 6;  ///< sync, set, length, checksum

struct Scanner : StartsWith<0x75> {
  static constexpr std::size_t kMaxFrameLength = kOverhead + 255;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

using Triple = std::array<double, 3>;

/// GPS time of a packet (shared 0xD3, sensor 0x12, filter 0x11).
struct GpsTime {
  double time_of_week_s = 0;
  std::uint16_t week = 0;
  bool time_of_week_valid = false, week_valid = false;
  bool operator==(const GpsTime&) const = default;
};

/// Answer to a command (descriptor 0xF1 of a command set).
struct Reply {
  std::uint8_t command = 0;
  std::uint8_t error = 0;  ///< 0: carried out
  bool operator==(const Reply&) const = default;
};

/// Base rate of a data set, answered to a command.
struct BaseRate {
  std::uint8_t set = 0;
  std::uint16_t rate_Hz = 0;
  bool operator==(const BaseRate&) const = default;
};

/// Fields of one packet; those that it lacks, or that the device marks as invalid, are absent. Body axes are x
/// forward, y to starboard, z down, as marked on the case.
struct Packet {
  std::uint8_t set = 0;
  std::optional<std::uint64_t> reference_time_ns;   ///< 0xD5: the device's own clock, at the time of validity
  std::optional<std::uint64_t> reference_delta_ns;  ///< 0xD6: since the packet before, of this set
  std::optional<double> delta_time_s;               ///< 0xD4
  std::optional<GpsTime> gps_time;
  std::optional<Reply> reply;
  std::optional<BaseRate> base_rate;  ///< decoded only

  // Sensor data, set 0x80.
  std::optional<Triple> acceleration_m_s2;  ///< specific force
  std::optional<Triple> rate_rad_s;
  std::optional<Triple> field_uT;
  std::optional<Triple> delta_theta_rad;
  std::optional<Triple> delta_velocity_m_s;
  std::optional<Triple> euler_rad;  ///< roll, pitch, yaw of the complementary filter
  std::optional<double> pressure_Pa;

  // Filter data, set 0x82.
  std::optional<Triple> filter_position;  ///< latitude and longitude in degrees, ellipsoid height in m
  std::optional<Triple> filter_velocity_ned_m_s;
  std::optional<Triple> filter_euler_rad;  ///< roll, pitch, yaw
  std::optional<Triple> filter_euler_std_rad;
  std::optional<Triple> filter_gyro_bias_rad_s;
  std::optional<Triple> filter_rate_rad_s;
  std::optional<std::uint16_t> filter_state;

  std::size_t unknown_fields = 0;  ///< without a decoder here
  std::size_t invalid_fields = 0;  ///< that the device marks as invalid, or that are too short
  bool operator==(const Packet&) const = default;
};

/// The fields of an intact packet. Bytes behind a field whose length cannot be are left and count as one invalid
/// field.
[[nodiscard]] Packet decode(Bytes frame);
/// The packet with all fields that are present. They fit into one packet for each set; unknown fields are not
/// made.
[[nodiscard]] std::vector<std::uint8_t> encode(const Packet& packet);

struct Field {
  std::uint8_t descriptor = 0;
  std::vector<std::uint8_t> data;
};
/// A packet of any fields: commands, and for the tests. All lengths together, with two bytes a field, are at most
/// 255.
[[nodiscard]] std::vector<std::uint8_t> encode_fields(std::uint8_t set, const std::vector<Field>& fields);

/// Commands without arguments of set 0x01.
enum class BaseCommand : std::uint8_t { ping = 0x01, set_to_idle = 0x02, resume = 0x06 };
[[nodiscard]] std::vector<std::uint8_t> encode_command(BaseCommand command);

/// Rate of a field: the base rate of its set divided by `decimation`.
struct FieldRate {
  std::uint8_t descriptor = 0;
  std::uint16_t decimation = 1;
};
/// 3DM message format (set 0x0C, 0x0F): which fields the packets of a data set have, at most 80.
[[nodiscard]] std::vector<std::uint8_t> encode_message_format(std::uint8_t set,
                                                              const std::vector<FieldRate>& rates);

}  // namespace navcal::protocols::mip
