// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "instruments/devices.h"
#include "instruments/mavlink_decoder.h"

namespace navcal::instruments {
namespace {

constexpr std::int64_t kAttitudeAge_ns = 100'000'000;

/// The sensors behind an autopilot at one port. The field gets the tilt of the newest attitude. The heading that
/// the autopilot estimates is no reading of a compass, and becomes a sample of its own.
class MavlinkVehicle final : public Instrument {
 public:
  explicit MavlinkVehicle(const config::PortSettings& settings)
      : unit_(settings.inertial_unit - 1), barometer_(settings.pressure_sensor - 1) {}

  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    const auto message = protocols::mavlink::find_message(frame.bytes).message;
    auto verdict = Verdict::ignored;
    for (MavlinkReading reading : decoder_.read(message)) {
      if (!is_wanted(reading)) continue;
      if (auto* const compass = std::get_if<CompassSample>(&reading.value)) complete(*compass, reading, receiver);
      hand_over_reading(reading, message.component, receiver);
      verdict = Verdict::used;
    }
    return message.system != decoder_.vehicle().value_or(message.system) ? Verdict::foreign : verdict;
  }

 private:
  [[nodiscard]] bool is_wanted(const MavlinkReading& reading) const {
    if (std::holds_alternative<DepthSample>(reading.value)) return reading.instance == barometer_;
    if (std::holds_alternative<PowerSample>(reading.value)) return reading.instance == 0;
    const auto* const compass = std::get_if<CompassSample>(&reading.value);
    if (compass != nullptr && !compass->field_body_uT) return true;
    return reading.instance == unit_ || (compass == nullptr && !std::holds_alternative<ImuSample>(reading.value));
  }

  void complete(CompassSample& compass, const MavlinkReading& reading, Receiver& receiver) {
    if (compass.heading_rad) {
      MavlinkReading heading = reading;
      heading.value = ScalarSample{Text<24>("autopilot_heading"), Text<16>("rad"), *compass.heading_rad, {}};
      hand_over_reading(heading, protocols::mavlink::kAutopilot, receiver);
      compass.heading_rad.reset();
      compass.heading_is_true = false;
      tilt_ = compass;
      tilt_ns_ = reading.device_time_ns;
    } else if (tilt_ns_ && reading.device_time_ns &&
               std::abs(*reading.device_time_ns - *tilt_ns_) <= kAttitudeAge_ns) {
      compass.pitch_rad = tilt_.pitch_rad;
      compass.roll_rad = tilt_.roll_rad;
    }
  }

  static void hand_over_reading(const MavlinkReading& reading, std::uint8_t component, Receiver& receiver) {
    const std::uint8_t clock = component == protocols::mavlink::kAutopilot ? 0 : component;
    receiver.on_measurement(
        {.value = reading.value, .device_time_ns = reading.device_time_ns, .paces = false, .clock = clock});
  }

  int unit_, barometer_;  ///< instances
  MavlinkDecoder decoder_;
  CompassSample tilt_;
  std::optional<std::int64_t> tilt_ns_;
};

}  // namespace

std::unique_ptr<Instrument> make_mavlink(const config::PortSettings& settings) {
  return std::make_unique<MavlinkVehicle>(settings);
}

}  // namespace navcal::instruments
