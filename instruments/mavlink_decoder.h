// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "instruments/autopilot_compass.h"
#include "instruments/instrument.h"
#include "protocols/mavlink.h"

namespace navcal::instruments {

/// One sample of a message. Of a compass it holds the field, or the attitude that the autopilot estimates.
struct MavlinkReading {
  Value value;
  int instance = 0;  ///< 0: the first sensor of its kind. Of SERVO_OUTPUT_RAW: number of the output
  std::optional<std::int64_t> device_time_ns{};  ///< by the clock of the component that sent it
};

/// Samples of MAVLink messages (ICD, "MAVLink"), live and in logs.
///
/// The vehicle is the first system whose autopilot (component 1) sends a heartbeat; one that keeps silent for ten
/// heartbeats of another autopilot is left for it. Other systems and components are not read, but for echo
/// sounders of the vehicle, and for motions over the bottom from whoever sends them. A field is taken when it has
/// changed, since an autopilot repeats it.
///
/// The autopilot's own calibration of its compass is undone where its parameters are known. They are waited for,
/// for five seconds of fields: without them the fields stay as they were sent, until the end.
class MavlinkDecoder {
 public:
  static constexpr int kPrimaryBarometer = 3;  ///< instance of HIGHRES_IMU's pressure

  /// The autopilot's own calibration of its compass: it is undone by parameters that are waited for, or have been
  /// taken before if there are any; or it is kept.
  enum class Calibration : std::uint8_t { waited_for, taken_before, kept };
  explicit MavlinkDecoder(Calibration calibration = Calibration::waited_for) : calibration_(calibration) {}
  /// A parameter of the autopilot that is known from elsewhere.
  void take_parameter(std::string_view name, double value) { compass_.take(name, value); }

  /// Samples of a message; none where it is of no use. Valid until the next call.
  [[nodiscard]] std::span<const MavlinkReading> read(const protocols::mavlink::Message& message);
  [[nodiscard]] std::optional<std::uint8_t> vehicle() const { return vehicle_; }
  /// True when fields of a compass (0: the first) were handed over as the autopilot has corrected them.
  [[nodiscard]] bool has_corrected_fields(int instance) const {
    return units_.at(static_cast<std::size_t>(instance)).is_corrected;
  }

 private:
  using Payload = protocols::mavlink::Payload;
  static constexpr std::size_t kUnits = 3;
  struct Unit {
    std::optional<Vector3> field_uT;
    std::int64_t field_ns = 0;                       ///< when it was taken
    std::optional<std::int64_t> waits_since_ns;      ///< for the parameters
    bool is_corrected = false;                       ///< the calibration is kept, or its parameters did not come
    std::optional<std::int64_t> high_resolution_ns;  ///< newest HIGHRES_IMU
  };

  void read_heartbeat(const protocols::mavlink::Message& message, const Payload& payload);
  void read_integers(const Payload& payload, std::size_t first, std::size_t temperature, int instance);
  void read_floats(const Payload& payload);
  void take(int instance, const ImuSample& imu, const std::optional<Vector3>& field_uT);
  /// Field without the autopilot's calibration. Nullopt while its parameters are waited for.
  std::optional<Vector3> measured_uT(int instance, const Vector3& sent_uT);
  void take_pressure(double hPa, double temperature_C, int instance);
  void read_gps(const Payload& payload);
  void read_battery(const Payload& payload);
  void read_outputs(const Payload& payload);
  void read_delta(const Payload& payload);
  void read_echo(const protocols::mavlink::Message& message, const Payload& payload);
  void put(const Value& value, int instance = 0);
  /// Time of the message since the boot, by a counter that begins anew after `span_ns`; 0: never. One that is not
  /// current counts near the newest alone.
  void set_time(std::int64_t time_ns, std::int64_t span_ns, bool is_current);
  void set_boot_ms(const Payload& payload);  ///< 32 bits at the beginning
  void set_boot_us(const Payload& payload);  ///< 64 bits likewise

  std::vector<MavlinkReading> readings_;
  std::optional<std::uint8_t> vehicle_;
  int others_ = 0;  ///< heartbeats of another autopilot since the last of the vehicle
  std::map<std::uint8_t, std::int64_t> newest_ns_;  ///< by component
  std::uint8_t component_ = 0;                      ///< of the message being read
  std::optional<std::int64_t> time_ns_;             ///< likewise
  std::array<Unit, kUnits> units_{};
  AutopilotCompass compass_;
  Calibration calibration_;
  std::optional<double> current_A_;  ///< newest of battery 1
  std::uint64_t fix_us_ = 0;
  bool has_battery_status_ = false;
  std::optional<std::uint8_t> echo_component_;
};

}  // namespace navcal::instruments
