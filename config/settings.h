// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/instruments.h"
#include "config/roles.h"
#include "protocols/described/description.h"
#include "protocols/frame.h"

namespace navcal::config {

enum class AngleUnit : std::uint8_t { deg, mils, counts16 };  ///< mils: 6400 to the turn; counts16: 65536
enum class TemperatureUnit : std::uint8_t { C, F };

/// Units that a compass was set or wired to send; its words do not contain them (ICD section 1).
struct CompassSettings {
  AngleUnit heading_unit = AngleUnit::deg;
  AngleUnit tilt_unit = AngleUnit::deg;
  TemperatureUnit temperature_unit = TemperatureUnit::C;

  bool operator==(const CompassSettings&) const = default;
};

/// Per-unit zeros and scales of the inertial card, channel by channel (ICD section 3).
struct ImuCardSettings {
  std::array<double, 8> zero_mV{2048, 2048, 2048, 2048, 2048, 2048, 2048, 250};
  /// mV per deg/s (gyros), per g (accelerometers), per m (depth).
  std::array<double, 8> scale{10, 10, 10, 10, 1000, 1000, 1000, 187.5};

  bool operator==(const ImuCardSettings&) const = default;
};

struct GpsSettings {
  /// Dates before it are moved up by whole 1024-week epochs; fixed, so that old logs replay alike for ever.
  std::string rollover_pivot = "2019-04-07";
  double course_gate_m_s = 0.3;  ///< below this speed the course is noise and is left out

  bool operator==(const GpsSettings&) const = default;
};

/// How a device sits in the vehicle (docs/navigation.md). Body axes x forward, y starboard, z down.
struct MountingSettings {
  /// Roll, pitch and yaw that turn the body's axes into the device's, about z, then y, then x.
  std::array<double, 3> rotation_deg{};
  /// Place of its sensor in body axes, from the vehicle's origin.
  std::array<double, 3> position_m{};

  bool operator==(const MountingSettings&) const = default;
};

struct PortSettings {
  std::string name;
  protocols::Protocol protocol = protocols::Protocol::nmea;
  // Exactly one of the four says where it is; empty when not given.
  std::string path;           ///< /dev/ttyUSB0, a pseudo-terminal, a link
  std::string udev_name;      ///< a link that udev keeps, e.g. /dev/navcal/compass or serial/by-id/...
  std::string usb_serial;     ///< serial number of the USB adapter
  std::string address;        ///< in the network (network_address.h)
  std::string serial_number;  ///< of the device itself, as on its plate; empty: not given
  int baud = 9600;
  bool start_up = true;          ///< hold the device's start-up dialogue
  bool aid = false;              ///< give a receiver position and time (docs/surfacing.md)
  bool require_checksum = true;  ///< of NMEA 0183; else sentences without one are taken, too
  bool low_latency = true;       ///< ask the driver for low latency
  double latency_s = 0;          ///< from measurement to the first byte on the wire
  double latency_std_s = 0;      ///< its uncertainty
  double rate_Hz = 0;            ///< nominal frame rate; 0: not periodic
  int inertial_unit = 1;         ///< MAVLink: 1 to 3, with its compass
  int pressure_sensor = 2;       ///< MAVLink: 1 to 3; 4: the primary barometer of HIGHRES_IMU
  CompassSettings compass;
  ImuCardSettings imu_card;
  GpsSettings gps;
  MountingSettings mounting;
  // A device that a file describes has these as well (docs/devices.md).
  std::string device;               ///< the file, as the configuration names it
  std::string description;          ///< its text: the configuration that a log has holds it
  std::vector<std::string> adjust;  ///< zeros and scales of this single device, as described::adjust() takes them
  std::optional<protocols::described::Description> described;  ///< the text as it was read, adjusted
  std::string signing_key_file;                                ///< MAVLink; empty: without signatures
  std::optional<std::array<std::uint8_t, 32>> signing_key{};   ///< read from it by navcald alone

  bool operator==(const PortSettings&) const = default;
};

/// Which vehicle this is; logs, status and pages name it.
struct IdentitySettings {
  std::string id;    ///< stays for the vehicle's life; empty: not given
  std::string name;  ///< for people; empty: the id

  bool operator==(const IdentitySettings&) const = default;
};

struct LogSettings {
  std::filesystem::path directory = "/var/lib/navcal";
  bool enabled = true;
  double sync_interval_s = 1.0;
  std::uint64_t rotate_bytes = 512'000'000;
  double rotate_age_s = 86400;
  std::uint64_t free_floor_bytes = 256'000'000;
  std::uint64_t queue_bytes = 32'000'000;  ///< bytes that may wait for a stalled disk before records are lost
  std::vector<std::string> leave_out;      ///< what is not logged, as in log_choice.h

  bool operator==(const LogSettings&) const = default;
};

struct StatusSettings {
  std::string address = "127.0.0.1";
  std::uint16_t port = 2947;
  std::uint32_t client_queue_bytes = 128'000;
  std::uint32_t max_clients = 256;
  double health_interval_s = 1.0;
  double nmea_heading_std_rad = 0.05235987755982988;  ///< largest standard error of a heading in HDT: 3 degrees

  bool operator==(const StatusSettings&) const = default;
};

struct ControlSettings {
  std::filesystem::path socket = "/run/navcal/control";
  std::uint32_t mode = 0660;

  bool operator==(const ControlSettings&) const = default;
};

/// The Earth's magnetic field where the vehicle is used. With `model`, declination, magnitude and dip that are 0
/// follow from the World Magnetic Model once the position is known.
struct EnvironmentSettings {
  bool model = true;
  double declination_rad = 0;  ///< positive east
  double field_uT = 0;         ///< magnitude of the local field; 0: not known
  double dip_rad = 0;          ///< positive down

  bool operator==(const EnvironmentSettings&) const = default;
};

/// Settings of the calibrators besides those of the instruments (InstrumentSettings), and when estimates are
/// accepted.
struct CalibrationSettings {
  bool enabled = true;
  bool automatic = true;         ///< estimates come into force by themselves
  double margin = 0.1;           ///< relative improvement on held-out readings that is required
  double motor_settle_s = 2;     ///< magnetic readings are left out so long after the motor was switched
  double heading_noise_rad = 0;  ///< of one reading; 0: as the compass's field and tilt give it
  double field_noise_uT = 0;     ///< likewise
  double bias_walk_rad_s = 0.00034906585039886593;  ///< std of the change in one second: 0.02 deg/s
  double compass_delay_s = 0;                       ///< of its readings behind their times; known beforehand
  double current_m_s = 0.15;                        ///< standard deviation of the water's, each axis
  /// Through the water for one revolution of the shaft; 0: not known.
  double advance_m = base::reference::kAdvance_m;

  bool operator==(const CalibrationSettings&) const = default;
};

/// Dead reckoning between fixes. Way of a revolution and currents are those of CalibrationSettings, noise of
/// fixes and the tilt's lag those of InstrumentSettings.
struct NavigationSettings {
  bool enabled = true;
  double interval_s = 1;                            ///< between reports
  double heading_error_rad = 0.087266462599716474;  ///< standard deviation, as the device says it: 5 degrees
  double heading_error_calibrated_rad = 0.017453292519943295;  ///< 1 degree
  double speed_error = 0.05;                                   ///< of the speed by the shaft, relative
  double speed_lag_s = base::reference::kSpeedLag_s;           ///< of the vehicle's speed behind its shaft's
  double max_error_m = 0;          ///< bound of the position error for the advice to surface, 95 %; 0: no advice
  double dvl_noise_m_s = 0.02;     ///< of one velocity where the device states none, each axis
  double dvl_scale_error = 0.005;  ///< of its velocities, relative; one standard deviation
  double dvl_alignment_error_rad = 0.008726646259971648;  ///< of its axes in the vehicle: 0.5 degrees
  double water_density_kg_m3 = 1025;
  double air_pressure_Pa = 101325;
  double altitude_noise_m = 0.1;   ///< of one reading of the altimeter, one standard deviation
  double altimeter_range_m = 100;  ///< readings beyond it are left out
  double min_altitude_m = 0;       ///< below it the floor is near; 0: not watched
  double floor_warning_s = 3;      ///< the floor is also near when the altitude will be less within this time

  bool operator==(const NavigationSettings&) const = default;
};

enum class OnLeak : std::uint8_t {
  alarm,  ///< an alarm and nothing else
  safe,   ///< leases of programs end, and the safe state is ordered
};

/// Limits of orders to the motor card, and the orders that apply when nobody holds a lease (docs/control.md).
/// Speeds and angles are in the card's own units.
struct CommandSettings {
  bool enabled = true;
  double max_rpm = 1200;     ///< ahead and astern
  double max_fin_deg = 25;   ///< either way
  double slew_rpm_s = 2000;  ///< how fast the order on the wire moves; 0: at once
  double slew_fin_deg_s = 200;
  double min_timeout_s = 0.2;  ///< bounds of a lease's own
  double max_timeout_s = 5;
  double max_orders_Hz = 40;
  double echo_timeout_s = 0.5;  ///< the card must have shown an order within this; 0: not watched
  double safe_rpm = 0;
  std::array<double, 3> safe_fins_deg{};
  OnLeak on_leak = OnLeak::safe;
  int operator_priority = 2;  ///< a lease of this priority or more is a person's: a leak does not end it

  bool operator==(const CommandSettings&) const = default;
};

enum class PowerAtStart : std::uint8_t { on, off, leave };

/// A supply that is switched by a GPIO line.
struct PowerSettings {
  std::string name;
  std::string gpio_chip;             ///< "gpiochip0"
  int line = -1;                     ///< offset on the chip
  std::vector<std::string> devices;  ///< names of the ports whose devices it feeds
  bool active_low = false;           ///< low level: on
  PowerAtStart at_start = PowerAtStart::on;
  double settle_s = 1;  ///< from switching on until the devices are spoken to

  bool operator==(const PowerSettings&) const = default;
};

/// The battery: counting of its charge, and what is known of the pack (docs/battery.md).
struct BatterySettings {
  bool enabled = false;
  double capacity_Ah = 3.7;
  double nominal_V = 21.6;
  double hotel_A = 0.5;           ///< current of all but the motor, where only the motor's is measured
  double hotel_error_A = 0.1;     ///< standard deviations from here on
  double current_error = 0.05;    ///< of a measured current, relative, the same all along
  double voltage_error_V = 0.15;  ///< of the curve, with the gauge's own
  double rest_A = 0.6;            ///< up to this current the voltage tells the charge
  double rest_s = 60;             ///< after so long a rest
  double resistance_ohm = 0.2;
  /// Open-circuit voltage at eight charges from empty to full, equally spaced; all 0: not known.
  std::array<double, 8> curve_V{18.0, 20.7, 21.5, 21.9, 22.5, 23.2, 24.1, 25.1};
  double low = 0.2;     ///< charge, relative to the capacity
  double low_V = 0;     ///< voltage under load; 0: not watched
  double mean_s = 120;  ///< time constant of the means of current and speed
  double interval_s = 1;

  bool operator==(const BatterySettings&) const = default;
};

/// What ends when the remote link is dead (docs/remote.md).
enum class OnDead : std::uint8_t {
  release,  ///< the lease that was taken over the link
  safe,     ///< every lease, that of a controller on board too
  nothing,  ///< none: each ends by its own time-out
};

/// The narrow link to an operator, over a serial port or TCP; off without path and listen.
struct RemoteSettings {
  std::string path;    ///< of the modem's serial port
  int baud = 57600;    ///< of that port
  std::string listen;  ///< "ADDRESS:PORT" for TCP
  std::string key_file;
  bool orders_without_key = false;
  double budget_B_s = 2000;  ///< sent at most
  double dead_s = 5;         ///< the link is dead after such a silence
  OnDead on_dead = OnDead::release;

  [[nodiscard]] bool enabled() const { return !path.empty() || !listen.empty(); }
  bool operator==(const RemoteSettings&) const = default;
};

struct Settings {
  IdentitySettings vehicle;
  LogSettings log;
  StatusSettings status;
  ControlSettings control;
  EnvironmentSettings environment;
  RoleSettings roles;
  InstrumentSettings instruments;
  CalibrationSettings calibration;
  NavigationSettings navigation;
  CommandSettings command;
  BatterySettings battery;
  RemoteSettings remote;
  std::vector<PortSettings> ports;
  std::vector<PowerSettings> power;

  bool operator==(const Settings&) const = default;
};

}  // namespace navcal::config
