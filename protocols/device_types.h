// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "protocols/frame.h"

/// The table of devices. Each Protocol has one row in it, and one entry in every PerDevice table; a device that
/// lacks one of them does not compile (docs/contributing.md).
namespace navcal::protocols {

/// Quantities that navigation and calibration need. One device delivers each of them.
enum class Role : std::uint8_t {
  heading,
  field,
  rates,
  acceleration,
  depth,
  position,
  velocity,  ///< over ground, by a receiver
  shaft,
  altitude,
  bottom_velocity,   ///< over the bottom, by a Doppler log
  water_velocity,    ///< through the water, likewise
  heading_reference  ///< true heading that the compass is calibrated against; of a port that the operator names
};

class RoleSet {
 public:
  constexpr RoleSet(std::initializer_list<Role> roles = {}) {
    for (const Role role : roles) add(role);
  }
  constexpr void add(Role role) { bits_ |= 1U << static_cast<unsigned>(role); }
  [[nodiscard]] constexpr bool has(Role role) const { return has_any({role}); }
  [[nodiscard]] constexpr bool has_any(RoleSet others) const { return (bits_ & others.bits_) != 0; }
  [[nodiscard]] constexpr bool is_empty() const { return bits_ == 0; }

 private:
  unsigned bits_ = 0;
};

/// For devices of which anything can come.
inline constexpr RoleSet kEverything{
    Role::heading,  Role::field, Role::rates,    Role::acceleration,    Role::depth,         Role::position,
    Role::velocity, Role::shaft, Role::altitude, Role::bottom_velocity, Role::water_velocity};

/// The tables of options that a port of this device has: [port.NAME.units], [port.NAME.channels], [port.NAME.fix].
struct OptionTables {
  bool units = false;
  bool channels = false;
  bool fix = false;
};

/// The port of the device on the reference vehicle.
struct VehiclePort {
  std::string_view name{};  ///< empty: the vehicle has no such device
  int baud = 0;
};

struct DeviceType {
  std::string_view name{};       ///< of its protocol in configurations, captures, logs and options
  int baud = 9600;               ///< line speed as delivered
  double latency_s = 0;          ///< from the measurement to the first byte on the wire
  double latency_std_s = 0;      ///< its uncertainty, one standard deviation
  double rate_Hz = 0;            ///< nominal frame rate; 0: none is known
  RoleSet delivers{};            ///< what it measures
  bool delivers_always = true;   ///< false: which of these it sends depends on the single device
  bool dates_roll_over = false;  ///< its dates can be whole epochs of 1024 weeks too early
  OptionTables options{};
  VehiclePort vehicle{};
  Protocol protocol{};             ///< kDeviceTypes fills it in
  bool heading_if_chosen = false;  ///< a true heading, too, of some set-ups: [roles] chooses it
};

/// The way of the device's bytes, as delivered.
struct Wire {
  int baud = 9600;
  double latency_s = 0, latency_std_s = 0, rate_Hz = 0;
};

/// Row of a device with the first members of DeviceType as stated, and the others of `row`.
constexpr DeviceType device(std::string_view name, const Wire& wire, DeviceType row) {
  row.name = name;
  row.baud = wire.baud;
  row.latency_s = wire.latency_s;
  row.latency_std_s = wire.latency_std_s;
  row.rate_Hz = wire.rate_Hz;
  return row;
}

/// One row for each device. Values that are not in the enumeration have a row without a name.
constexpr DeviceType device_row(Protocol protocol) {
  using enum Role;
  switch (protocol) {
    case Protocol::tcm2:
      return device("tcm2", {.baud = 9600, .latency_s = 0.050, .latency_std_s = 0.002, .rate_Hz = 10},
                    {.delivers = {heading, field}, .options = {.units = true}, .vehicle = {"compass", 38400}});
    case Protocol::imu_card:
      return device(
          "imu-card", {.baud = 57600, .latency_s = 0.025, .latency_std_s = 0.0005, .rate_Hz = 20},
          {.delivers = {rates, acceleration, depth}, .options = {.channels = true}, .vehicle = {"imu", 57600}});
    case Protocol::oncore:
      return device("oncore", {.baud = 9600, .latency_s = 0.300, .latency_std_s = 0.020, .rate_Hz = 1},
                    {.delivers = {position, velocity},
                     .dates_roll_over = true,
                     .options = {.fix = true},
                     .vehicle = {"gps", 9600}});
    case Protocol::motor_card:
      return device("motor-card", {.baud = 19200, .latency_s = 0.005, .latency_std_s = 0.001, .rate_Hz = 10},
                    {.delivers = {shaft}, .vehicle = {"motor", 19200}});
    case Protocol::nmea:
      // Receivers and compasses of all kinds: nothing is known of them but that they are not quicker than this.
      return device("nmea", {.baud = 4800, .latency_std_s = 0.050},
                    {.delivers = {heading, position, velocity, altitude},
                     .delivers_always = false,
                     .options = {.units = true, .fix = true}});
    case Protocol::ubx:
      return device("ubx", {.baud = 38400, .latency_s = 0.050, .latency_std_s = 0.020, .rate_Hz = 1},
                    {.delivers = {position, velocity}, .options = {.fix = true}, .heading_if_chosen = true});
    case Protocol::mip:
      return device("mip", {.baud = 115200, .latency_s = 0.003, .latency_std_s = 0.001, .rate_Hz = 100},
                    {.delivers = {heading, field, rates, acceleration}, .delivers_always = false});
    case Protocol::vectornav:
      return device("vectornav", {.baud = 115200, .latency_s = 0.003, .latency_std_s = 0.001, .rate_Hz = 40},
                    {.delivers = {heading, field, rates, acceleration}, .delivers_always = false});
    case Protocol::pni:
      return device("pni", {.baud = 38400, .latency_s = 0.030, .latency_std_s = 0.005, .rate_Hz = 10},
                    {.delivers = {heading, field, acceleration}, .delivers_always = false});
    case Protocol::pd0:
      // The ping rate of a Doppler log depends on the range to the bottom.
      return device(
          "pd0", {.baud = 115200, .latency_s = 0.100, .latency_std_s = 0.050},
          {.delivers = {heading, depth, altitude, bottom_velocity, water_velocity}, .delivers_always = false});
    case Protocol::pd6:
      return device("pd6", {.baud = 115200, .latency_s = 0.100, .latency_std_s = 0.050},
                    {.delivers = {heading, altitude, bottom_velocity, water_velocity}, .delivers_always = false});
    case Protocol::water_linked:
      return device("waterlinked", {.baud = 115200, .latency_s = 0.100, .latency_std_s = 0.050},
                    {.delivers = {altitude, bottom_velocity}, .delivers_always = false});
    case Protocol::samples:
      // Whatever another program knows; it states the times of validity itself. No wire delays its lines.
      return device("samples", {.baud = 4'000'000, .latency_std_s = 0.010},
                    {.delivers = kEverything, .delivers_always = false});
    case Protocol::paroscientific:
      // As delivered it integrates for 0.67 s and sends the mean.
      return device("paroscientific", {.baud = 9600, .latency_s = 0.350, .latency_std_s = 0.100},
                    {.delivers = {depth}});
    case Protocol::keller:
      // It answers when it is asked: the host paces it.
      return device("keller", {.baud = 9600, .latency_s = 0.005, .latency_std_s = 0.005}, {.delivers = {depth}});
    case Protocol::described:
      // What a file describes (protocols/described/): of a single device, its description says what it delivers.
      return device("described", {.baud = 9600, .latency_std_s = 0.050},
                    {.delivers = kEverything, .delivers_always = false});
    case Protocol::mavlink:
      // The sensors behind an autopilot, most often through the network. It stamps as it sends.
      return device(
          "mavlink", {.baud = 4'000'000, .latency_std_s = 0.002},
          {.delivers = {heading, field, rates, acceleration, depth, position, velocity, altitude, bottom_velocity},
           .delivers_always = false});
  }
  return {};
}

inline constexpr std::size_t kDeviceCount = [] {
  std::size_t count = 0;
  while (!device_row(static_cast<Protocol>(count)).name.empty()) ++count;
  return count;
}();

/// All rows, in the order of Protocol.
inline constexpr std::array<DeviceType, kDeviceCount> kDeviceTypes = [] {
  std::array<DeviceType, kDeviceCount> rows{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = device_row(static_cast<Protocol>(i));
    rows[i].protocol = static_cast<Protocol>(i);
  }
  return rows;
}();

/// `protocol` must be one of the enumeration.
[[nodiscard]] constexpr const DeviceType& device_type(Protocol protocol) {
  return kDeviceTypes.at(static_cast<std::size_t>(protocol));
}

/// What a room adds to each row, such as the maker of a device's instrument. Declare it constexpr: entries that
/// are fewer than the devices, or in another order than Protocol, then do not compile.
template <class T>
class PerDevice {
 public:
  struct Entry {
    Protocol protocol;
    T value;
  };

  template <std::size_t N>
  constexpr explicit PerDevice(const Entry (&entries)[N]) {
    static_assert(N == kDeviceCount, "each device of protocols/device_types.h needs one entry in this table");
    for (std::size_t i = 0; i < N; ++i) {
      if (entries[i].protocol != kDeviceTypes[i].protocol) throw "the entries must be in the order of Protocol";
      values_[i] = entries[i].value;
    }
  }
  [[nodiscard]] constexpr const T& operator[](Protocol protocol) const {
    return values_.at(static_cast<std::size_t>(protocol));
  }

 private:
  std::array<T, kDeviceCount> values_{};
};

}  // namespace navcal::protocols
