// SPDX-License-Identifier: Apache-2.0
#include "instruments/described_device.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/angles.h"

namespace navcal::instruments {
namespace {

using protocols::described::Field;
using protocols::described::FrameKind;
using protocols::described::Meaning;

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

std::size_t place(Meaning meaning) { return static_cast<std::size_t>(meaning); }

bool has_any(const std::vector<Meaning>& meanings, std::initializer_list<Meaning> wanted) {
  return std::any_of(meanings.begin(), meanings.end(), [&](Meaning meaning) {
    return std::find(wanted.begin(), wanted.end(), meaning) != wanted.end();
  });
}

std::optional<double> heading_of(std::optional<double> angle_rad) {
  return angle_rad ? std::optional(base::positive_angle(*angle_rad)) : std::nullopt;
}

std::optional<std::uint8_t> count_of(std::optional<double> number) {
  return number ? std::optional(static_cast<std::uint8_t>(std::clamp(*number, 0.0, 255.0))) : std::nullopt;
}

/// The lowest eight bits of a counter.
std::optional<std::uint8_t> sequence_of(std::optional<double> counter) {
  return counter ? std::optional(static_cast<std::uint8_t>(std::fmod(*counter, 256))) : std::nullopt;
}

/// Gives measurements of one frame one time.
class FrameSink {
 public:
  FrameSink(std::optional<std::uint8_t> sequence, std::optional<std::int64_t> utc_ns, Receiver& receiver)
      : sequence_(sequence), utc_ns_(utc_ns), receiver_(receiver) {}

  void take(const Value& value, bool utc_is_known = false) {
    Measurement measurement;
    measurement.value = value;
    measurement.sequence = sequence_;
    measurement.stated_utc_ns = utc_ns_;
    measurement.utc_is_known = utc_is_known;
    measurement.paces = !any_;
    any_ = true;
    receiver_.on_measurement(measurement);
  }
  [[nodiscard]] bool any() const { return any_; }

 private:
  std::optional<std::uint8_t> sequence_;
  std::optional<std::int64_t> utc_ns_;
  Receiver& receiver_;
  bool any_ = false;
};

}  // namespace

DescribedDevice::Kind::Kind(const FrameKind& kind, bool is_text)
    : id(kind.id), reader(kind, is_text), values(kind.fields.size(), kAbsent) {
  by_meaning.fill(kAbsent);
  for (std::size_t i = 0; i < kind.fields.size(); ++i) {
    const Field& field = kind.fields[i];
    meanings.push_back(field.meaning);
    std_by_meaning.at(place(field.meaning)) = field.std;
    if (field.meaning == Meaning::sensor)
      sensors.push_back({i, Text<24>(field.name), Text<16>(field.unit), field.std});
  }
  using M = Meaning;
  is_imu = has_any(meanings, {M::rate_x, M::rate_yaw_b, M::specific_force_x});
  is_compass =
      has_any(meanings, {M::heading, M::heading_true, M::pitch, M::roll, M::field_x, M::dip, M::turn_rate});
  is_gps = has_any(meanings, {M::latitude, M::speed, M::course, M::climb, M::height, M::height_msl});
  is_motor = has_any(meanings, {M::rpm, M::rpm_commanded, M::fin_1, M::fin_2, M::fin_3, M::motor_current});
  is_power = has_any(meanings, {M::voltage, M::current});
  is_dvl = has_any(meanings, {M::bottom_velocity_x, M::bottom_velocity_north, M::water_velocity_x,
                              M::water_velocity_north, M::sound_speed});
  is_depth = has_any(meanings, {M::pressure}) || (!is_imu && has_any(meanings, {M::depth}));
  is_altimeter = !is_dvl && has_any(meanings, {M::altitude});
  is_thermometer = !is_imu && !is_compass && !is_dvl && !is_depth && has_any(meanings, {M::temperature});
  has_card_state = has_any(meanings, {M::leak_forward, M::leak_aft, M::low_supply});
}

std::optional<double> DescribedDevice::Kind::value(Meaning meaning) const {
  const double number = by_meaning[place(meaning)];
  return std::isnan(number) ? std::nullopt : std::optional(number);
}

std::optional<Vector3> DescribedDevice::Kind::vector(Meaning first) const {
  const double* const numbers = by_meaning.data() + place(first);
  if (std::isnan(numbers[0]) || std::isnan(numbers[1]) || std::isnan(numbers[2])) return std::nullopt;
  return Vector3{numbers[0], numbers[1], numbers[2]};
}

DescribedDevice::DescribedDevice(const config::PortSettings& settings) {
  if (!settings.described) return;
  for (const FrameKind& kind : settings.described->kinds) kinds_.emplace_back(kind, settings.described->is_text);
}

Instrument::Verdict DescribedDevice::read(const protocols::Frame& frame, Receiver& receiver) {
  const auto found =
      std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& kind) { return kind.id == frame.id; });
  if (found == kinds_.end()) return Verdict::ignored;
  Kind& kind = *found;
  if (!kind.reader.read(frame.bytes, kind.values)) return Verdict::out_of_range;
  for (std::size_t i = 0; i < kind.values.size(); ++i) kind.by_meaning[place(kind.meanings[i])] = kind.values[i];
  return hand_over(kind, receiver) ? Verdict::used : Verdict::ignored;
}

ImuSample DescribedDevice::imu_of(const Kind& kind) {
  ImuSample sample;
  sample.rate_rad_s = kind.vector(Meaning::rate_x);
  sample.yaw_rate_b_rad_s = kind.value(Meaning::rate_yaw_b);
  sample.specific_force_m_s2 = kind.vector(Meaning::specific_force_x);
  sample.depth_m = kind.value(Meaning::depth);
  sample.temperature_C = kind.value(Meaning::temperature);
  sample.over_range = kind.flag(Meaning::over_range);
  if (kind.has_card_state) {
    sample.card = {.sequence = sequence_of(kind.value(Meaning::sequence)).value_or(0),
                   .leak_forward = kind.flag(Meaning::leak_forward),
                   .leak_aft = kind.flag(Meaning::leak_aft),
                   .low_supply = kind.flag(Meaning::low_supply)};
  }
  sample.rate_std_rad_s = kind.std(Meaning::rate_x);
  sample.specific_force_std_m_s2 = kind.std(Meaning::specific_force_x);
  sample.depth_std_m = kind.std(Meaning::depth);
  return sample;
}

CompassSample DescribedDevice::compass_of(const Kind& kind) {
  CompassSample sample;
  const auto heading_true = kind.value(Meaning::heading_true);
  sample.heading_is_true = heading_true.has_value();
  sample.heading_rad = heading_of(heading_true ? heading_true : kind.value(Meaning::heading));
  sample.pitch_rad = kind.value(Meaning::pitch);
  sample.roll_rad = kind.value(Meaning::roll);
  sample.field_body_uT = kind.vector(Meaning::field_x);
  sample.dip_rad = kind.value(Meaning::dip);
  sample.turn_rate_rad_s = kind.value(Meaning::turn_rate);
  // A sensor's temperature is said once, with the readings that depend on it most.
  if (!kind.is_imu) sample.temperature_C = kind.value(Meaning::temperature);
  sample.heading_std_rad = kind.std(heading_true ? Meaning::heading_true : Meaning::heading);
  sample.tilt_std_rad = kind.std(Meaning::pitch);
  sample.field_std_uT = kind.std(Meaning::field_x);
  return sample;
}

GpsSample DescribedDevice::gps_of(const Kind& kind) {
  GpsSample sample;
  sample.latitude_rad = kind.value(Meaning::latitude);
  sample.longitude_rad = kind.value(Meaning::longitude);
  if (sample.longitude_rad) sample.longitude_rad = base::wrapped(*sample.longitude_rad);
  sample.height_m = kind.value(Meaning::height);
  sample.height_msl_m = kind.value(Meaning::height_msl);
  const bool has_place = sample.latitude_rad && sample.longitude_rad;
  const bool has_height = sample.height_m || sample.height_msl_m;
  sample.fix = !has_place ? Fix::none : has_height ? Fix::fix_3d : Fix::fix_2d;
  sample.speed_m_s = kind.value(Meaning::speed);
  sample.course_rad = heading_of(kind.value(Meaning::course));
  sample.climb_m_s = kind.value(Meaning::climb);
  sample.dop = kind.value(Meaning::dop);
  sample.tracked = count_of(kind.value(Meaning::satellites));
  sample.position_std_m = kind.std(Meaning::latitude);
  sample.height_std_m = kind.std(Meaning::height);
  sample.velocity_std_m_s = kind.std(Meaning::speed);
  return sample;
}

MotorSample DescribedDevice::motor_of(const Kind& kind) {
  MotorSample sample;
  sample.rpm = kind.value(Meaning::rpm);
  sample.rpm_commanded = kind.value(Meaning::rpm_commanded);
  sample.fins_rad = {kind.value(Meaning::fin_1), kind.value(Meaning::fin_2), kind.value(Meaning::fin_3)};
  sample.current_A = kind.value(Meaning::motor_current);
  sample.sequence = sequence_of(kind.value(Meaning::sequence));
  sample.fins_std_rad = kind.std(Meaning::fin_1);
  sample.current_std_A = kind.std(Meaning::motor_current);
  return sample;
}

DvlSample DescribedDevice::dvl_of(const Kind& kind) {
  DvlSample sample;
  sample.bottom_velocity_m_s = kind.vector(Meaning::bottom_velocity_x);
  sample.water_velocity_m_s = kind.vector(Meaning::water_velocity_x);
  sample.bottom_velocity_std_m_s = kind.std(Meaning::bottom_velocity_x);
  sample.water_velocity_std_m_s = kind.std(Meaning::water_velocity_x);
  if (has_any(kind.meanings, {Meaning::bottom_velocity_north, Meaning::water_velocity_north})) {
    sample.frame = VelocityFrame::earth;
    sample.bottom_velocity_m_s = kind.vector(Meaning::bottom_velocity_north);
    sample.water_velocity_m_s = kind.vector(Meaning::water_velocity_north);
    sample.bottom_velocity_std_m_s = kind.std(Meaning::bottom_velocity_north);
    sample.water_velocity_std_m_s = kind.std(Meaning::water_velocity_north);
  }
  sample.altitude_m = kind.value(Meaning::altitude);
  sample.altitude_std_m = kind.std(Meaning::altitude);
  sample.sound_speed_m_s = kind.value(Meaning::sound_speed);
  if (!kind.is_imu && !kind.is_compass) sample.temperature_C = kind.value(Meaning::temperature);
  return sample;
}

DepthSample DescribedDevice::depth_of(const Kind& kind) {
  DepthSample sample;
  sample.pressure_Pa = kind.value(Meaning::pressure);
  sample.pressure_std_Pa = kind.std(Meaning::pressure);
  if (kind.is_imu) return sample;  // which has the depth and the temperature
  sample.depth_m = kind.value(Meaning::depth);
  sample.depth_std_m = kind.std(Meaning::depth);
  if (!kind.is_compass && !kind.is_dvl) sample.temperature_C = kind.value(Meaning::temperature);
  return sample;
}

bool DescribedDevice::hand_over(const Kind& kind, Receiver& receiver) {
  const auto utc_s = kind.value(Meaning::utc);
  const auto utc_ns = utc_s ? std::optional(static_cast<std::int64_t>(std::llround(*utc_s * 1e9))) : std::nullopt;
  FrameSink sink(sequence_of(kind.value(Meaning::sequence)), utc_ns, receiver);
  if (kind.is_imu) sink.take(imu_of(kind));
  if (kind.is_compass) sink.take(compass_of(kind));
  if (kind.is_gps) {
    GpsSample gps = gps_of(kind);
    gps.time_utc_ns = utc_ns;
    sink.take(gps, utc_ns.has_value() && gps.fix != Fix::none);
  }
  if (kind.is_motor) sink.take(motor_of(kind));
  if (kind.is_dvl) sink.take(dvl_of(kind));
  if (kind.is_depth) sink.take(depth_of(kind));
  if (const auto altitude_m = kind.value(Meaning::altitude); kind.is_altimeter && altitude_m)
    sink.take(AltimeterSample{*altitude_m, kind.std(Meaning::altitude)});
  if (kind.is_power) {
    const PowerSample power{kind.value(Meaning::voltage), kind.value(Meaning::current)};
    if (power.voltage_V || power.current_A) sink.take(power);
  }
  if (const auto temperature_C = kind.value(Meaning::temperature); kind.is_thermometer && temperature_C)
    sink.take(
        ScalarSample{Text<24>("temperature"), Text<16>("C"), *temperature_C, kind.std(Meaning::temperature)});
  for (const Sensor& sensor : kind.sensors) {
    const double value = kind.values[sensor.field];
    if (!std::isnan(value)) sink.take(ScalarSample{sensor.quantity, sensor.unit, value, sensor.std});
  }
  return sink.any();
}

}  // namespace navcal::instruments
