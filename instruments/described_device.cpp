// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "base/angles.h"
#include "base/durations.h"
#include "instruments/devices.h"
#include "instruments/sample_fields.h"
#include "protocols/described/reading.h"

namespace navcal::instruments {

namespace {

using protocols::described::Field;
using protocols::described::FrameKind;
using protocols::described::Meaning;

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

std::size_t place(Meaning meaning) { return static_cast<std::size_t>(meaning); }

bool has_any(const std::vector<Meaning>& meanings, std::initializer_list<Meaning> wanted) {
  return std::ranges::any_of(
      meanings, [&](Meaning meaning) { return std::find(wanted.begin(), wanted.end(), meaning) != wanted.end(); });
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
    receiver_.on_measurement({.value = value,
                              .sequence = sequence_,
                              .stated_utc_ns = utc_ns_,
                              .utc_is_known = utc_is_known,
                              .paces = !any_});
    any_ = true;
  }
  [[nodiscard]] bool any() const { return any_; }

 private:
  std::optional<std::uint8_t> sequence_;
  std::optional<std::int64_t> utc_ns_;
  Receiver& receiver_;
  bool any_ = false;
};

/// A mission sensor among the fields.
struct Sensor {
  std::size_t field = 0;
  Text<24> quantity;
  Text<16> unit;
  std::optional<double> std;
};

/// One kind of frame: where its values go, and which samples they make.
struct Kind {
  explicit Kind(const FrameKind& kind, bool is_text);

  protocols::FrameId id;
  protocols::described::FrameReader reader;
  std::vector<Meaning> meanings;  ///< of the fields, in their order
  std::vector<double> values;     ///< of the newest frame, in the same order; NaN: absent
  /// The same by meaning; those that the frame does not have are always NaN.
  std::array<double, protocols::described::kMeaningCount> by_meaning{};
  std::array<std::optional<double>, protocols::described::kMeaningCount> std_by_meaning;
  std::vector<Sensor> sensors;
  bool is_imu = false, is_compass = false, is_gps = false, is_motor = false, is_power = false, is_dvl = false,
       is_depth = false, is_altimeter = false, is_thermometer = false;
  bool has_card_state = false;

  [[nodiscard]] std::optional<double> value(Meaning meaning) const;
  [[nodiscard]] std::optional<double> std(Meaning meaning) const {
    return std_by_meaning[static_cast<std::size_t>(meaning)];
  }
  [[nodiscard]] bool flag(Meaning meaning) const { return value(meaning).value_or(0) != 0; }
  /// All three of consecutive meanings, or nothing.
  [[nodiscard]] std::optional<Vector3> vector(Meaning first) const;
};

Kind::Kind(const FrameKind& kind, bool is_text)
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

std::optional<double> Kind::value(Meaning meaning) const {
  const double number = by_meaning[place(meaning)];
  return std::isnan(number) ? std::nullopt : std::optional(number);
}

std::optional<Vector3> Kind::vector(Meaning first) const {
  const double* const numbers = by_meaning.data() + place(first);
  if (std::isnan(numbers[0]) || std::isnan(numbers[1]) || std::isnan(numbers[2])) return std::nullopt;
  return Vector3{numbers[0], numbers[1], numbers[2]};
}

/// Members by their meaning; the rules between members are those of the functions below.
template <class S>
S sample_of(const Kind& kind) {
  S sample;
  if constexpr (requires { sample.card; }) {
    if (kind.has_card_state) sample.card.emplace();
  }
  for_each_field<S>([&]<class Owner, class T>(const kind::Field<Owner, T>& field) {
    auto* const member = member_of(sample, field);
    if (field.meaning == Meaning::none || member == nullptr) return;
    if constexpr (std::is_same_v<T, bool>) {
      *member = kind.flag(field.meaning);
    } else if constexpr (std::is_same_v<T, std::uint8_t>) {
      *member = sequence_of(kind.value(field.meaning)).value_or(0);
    } else if constexpr (std::is_same_v<T, std::optional<std::uint8_t>>) {
      const auto number = kind.value(field.meaning);
      *member = field.meaning == Meaning::sequence ? sequence_of(number) : count_of(number);
    } else if constexpr (std::is_same_v<T, std::optional<Vector3>>) {
      *member = kind.vector(field.meaning);
    } else if constexpr (std::is_same_v<T, std::array<std::optional<double>, 3>>) {
      for (std::size_t i = 0; i < 3; ++i)
        (*member)[i] = kind.value(static_cast<Meaning>(place(field.meaning) + i));
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      *member = field.quantity.role == Role::error ? kind.std(field.meaning) : kind.value(field.meaning);
      if (field.quantity.form == Form::direction) *member = heading_of(*member);
    }
  });
  return sample;
}

CompassSample compass_of(const Kind& kind) {
  auto sample = sample_of<CompassSample>(kind);
  if (const auto heading_true = kind.value(Meaning::heading_true)) {
    sample.heading_is_true = true;
    sample.heading_rad = heading_of(heading_true);
    sample.heading_std_rad = kind.std(Meaning::heading_true);
  }
  // A sensor's temperature is said once, with the readings that depend on it most.
  if (kind.is_imu) sample.temperature_C.reset();
  return sample;
}

GpsSample gps_of(const Kind& kind) {
  auto sample = sample_of<GpsSample>(kind);
  if (sample.longitude_rad) sample.longitude_rad = base::wrapped(*sample.longitude_rad);
  const bool has_place = sample.latitude_rad && sample.longitude_rad;
  const bool has_height = sample.height_m || sample.height_msl_m;
  sample.fix = !has_place ? Fix::none : has_height ? Fix::fix_3d : Fix::fix_2d;
  return sample;
}

DvlSample dvl_of(const Kind& kind) {
  auto sample = sample_of<DvlSample>(kind);
  if (has_any(kind.meanings, {Meaning::bottom_velocity_north, Meaning::water_velocity_north})) {
    sample.frame = VelocityFrame::earth;
    sample.bottom_velocity_m_s = kind.vector(Meaning::bottom_velocity_north);
    sample.water_velocity_m_s = kind.vector(Meaning::water_velocity_north);
    sample.bottom_velocity_std_m_s = kind.std(Meaning::bottom_velocity_north);
    sample.water_velocity_std_m_s = kind.std(Meaning::water_velocity_north);
  }
  if (kind.is_imu || kind.is_compass) sample.temperature_C.reset();
  return sample;
}

DepthSample depth_of(const Kind& kind) {
  auto sample = sample_of<DepthSample>(kind);
  if (kind.is_imu || kind.is_compass || kind.is_dvl) sample.temperature_C.reset();
  if (kind.is_imu) sample.depth_m = sample.depth_std_m = std::nullopt;  // which has the depth
  return sample;
}

/// Hands over the samples of the newest frame; false when it has none.
bool hand_over_samples(const Kind& kind, Receiver& receiver) {
  const auto utc_s = kind.value(Meaning::utc);
  const auto utc_ns = utc_s ? std::optional(static_cast<std::int64_t>(std::llround(*utc_s * 1e9))) : std::nullopt;
  FrameSink sink(sequence_of(kind.value(Meaning::sequence)), utc_ns, receiver);
  if (kind.is_imu) sink.take(sample_of<ImuSample>(kind));
  if (kind.is_compass) sink.take(compass_of(kind));
  if (kind.is_gps) {
    GpsSample gps = gps_of(kind);
    gps.time_utc_ns = utc_ns;
    sink.take(gps, utc_ns.has_value() && gps.fix != Fix::none);
  }
  if (kind.is_motor) sink.take(sample_of<MotorSample>(kind));
  if (kind.is_dvl) sink.take(dvl_of(kind));
  if (kind.is_depth) sink.take(depth_of(kind));
  if (const auto altitude_m = kind.value(Meaning::altitude); kind.is_altimeter && altitude_m)
    sink.take(AltimeterSample{*altitude_m, kind.std(Meaning::altitude)});
  if (kind.is_power) {
    const auto power = sample_of<PowerSample>(kind);
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

/// A device that a file describes (docs/devices.md). One frame can give samples of several kinds; the first of
/// them paces the device's clock.
class DescribedDevice final : public Instrument {
 public:
  /// Without a description in the settings, every frame is ignored.
  explicit DescribedDevice(const config::PortSettings& settings) {
    if (!settings.described) return;
    for (const FrameKind& kind : settings.described->kinds) kinds_.emplace_back(kind, settings.described->is_text);
  }

  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    const auto found = std::ranges::find_if(kinds_, [&](const Kind& kind) { return kind.id == frame.id; });
    if (found == kinds_.end()) return Verdict::ignored;
    Kind& kind = *found;
    if (!kind.reader.read(frame.bytes, kind.values)) return Verdict::out_of_range;
    for (std::size_t i = 0; i < kind.values.size(); ++i) kind.by_meaning[place(kind.meanings[i])] = kind.values[i];
    return hand_over_samples(kind, receiver) ? Verdict::used : Verdict::ignored;
  }

 private:
  std::vector<Kind> kinds_;
};

}  // namespace

std::unique_ptr<Instrument> make_described(const config::PortSettings& settings) {
  return std::make_unique<DescribedDevice>(settings);
}

namespace {

/// Devices that read their commands slowly lose what comes without a pause.
constexpr std::int64_t kPause_ns = base::kSecond_ns / 5;
/// So long without a frame, the device has lost its power or its settings.
constexpr std::int64_t kSilence_ns = 10 * base::kSecond_ns;

std::string sent_text(unsigned rounds) {
  return rounds == 1 ? "start-up lines sent" : fmt::format("start-up lines sent {} times, no frames", rounds);
}

/// Sends the start-up lines of a description, with a pause between them, and again when no frame of the device has
/// come for a while. Answers are not waited for: a description does not know them.
class StartUpDescribed final : public StartUp {
 public:
  explicit StartUpDescribed(std::vector<std::string> lines) : StartUp(kSending), lines_(std::move(lines)) {}

 private:
  Script script() override {
    const auto is_frame = [](const protocols::Frame&) { return true; };
    const auto bytes_of = [](const std::string& line) {
      return std::vector<std::uint8_t>(line.begin(), line.end());
    };
    enter(kSending);
    all_sent_ = false;
    for (unsigned rounds = 1;; ++rounds) {
      for (std::size_t i = 0; i + 1 < lines_.size(); ++i) co_await send(bytes_of(lines_[i]), kPause_ns);
      all_sent_ = true;
      enter(in_service() ? "running" : sent_text(rounds), in_service());
      bool frames_come = co_await ask(bytes_of(lines_.back()), 1, kSilence_ns, is_frame);
      while (frames_come) frames_come = co_await wait(kSilence_ns, is_frame);
      enter(sent_text(rounds));
    }
  }
  void on_any_frame(const protocols::Frame&) override { enter(all_sent_ ? "running" : kSending, true); }

  static constexpr const char* kSending = "sending the start-up lines";
  std::vector<std::string> lines_;
  bool all_sent_ = false;  ///< once
};

}  // namespace

std::unique_ptr<StartUp> start_described(const config::PortSettings& settings) {
  const bool has_lines = settings.described && !settings.described->start_up.empty();
  return has_lines ? std::make_unique<StartUpDescribed>(settings.described->start_up) : nullptr;
}

}  // namespace navcal::instruments
