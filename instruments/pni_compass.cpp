// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/angles.h"
#include "base/durations.h"
#include "instruments/devices.h"
#include "protocols/tcm2_word.h"
#include "protocols/trax.h"

namespace navcal::instruments {

namespace {

namespace trax = protocols::trax;

constexpr double kMostField = 1000, kMostAcceleration_m_s2 = 100, kMostTemperature_C = 150;

bool is_between(const std::optional<double>& value, double least, double greatest) {
  return !value || (*value >= least && *value <= greatest);
}

/// Not-a-number lies between nothing.
bool is_possible_data(const trax::Data& data) {
  const auto all = [](const auto& axes, double most) {
    return std::all_of(axes.begin(), axes.end(), [&](const auto& axis) { return is_between(axis, -most, most); });
  };
  return is_between(data.heading_deg, 0, 360) && is_between(data.pitch_deg, -90, 90) &&
         is_between(data.roll_deg, -180, 180) &&
         is_between(data.temperature_C, -kMostTemperature_C, kMostTemperature_C) &&
         all(data.field_uT, kMostField) && all(data.acceleration_m_s2, kMostAcceleration_m_s2);
}

std::optional<Vector3> vector_of_axes(const std::array<std::optional<double>, 3>& axes) {
  if (!axes[0] || !axes[1] || !axes[2]) return std::nullopt;
  return Vector3{*axes[0], *axes[1], *axes[2]};
}

/// Specific force: -9.81 in z when level and still. The sign of the device's axes is not known from a source at
/// hand; its own roll and pitch show where down is. nullopt without them, and in free fall.
std::optional<Vector3> specific_force(const Vector3& acceleration_m_s2, const CompassSample& compass) {
  if (!compass.roll_rad || !compass.pitch_rad) return std::nullopt;
  const double cos_pitch = std::cos(*compass.pitch_rad);
  const Vector3 down{-std::sin(*compass.pitch_rad), std::sin(*compass.roll_rad) * cos_pitch,
                     std::cos(*compass.roll_rad) * cos_pitch};
  double along_m_s2 = 0;
  for (std::size_t i = 0; i < 3; ++i) along_m_s2 += down[i] * acceleration_m_s2[i];
  if (along_m_s2 == 0) return std::nullopt;
  Vector3 force_m_s2 = acceleration_m_s2;
  if (along_m_s2 > 0) {
    for (double& axis : force_m_s2) axis = -axis;
  }
  return force_m_s2;
}

}  // namespace

/// PNI TRAX, TCM3 and Prime (ICD section 11): heading, tilt, field and temperature as CompassSample, acceleration
/// as ImuSample of the same time. The heading is taken for magnetic, as the start-up dialogue sets it. Distortion
/// is a remark, as the TCM2's E001. The device's heading status is not used: no source at hand says what it means.
Verdict read_pni(const protocols::Frame& frame, const config::PortSettings&, Receiver& receiver) {
  if (frame.id != trax::id_of(static_cast<std::uint8_t>(trax::FrameNumber::data))) return Verdict::ignored;
  const auto data = trax::decode_data(frame.bytes);
  if (!data || !is_possible_data(*data)) return Verdict::out_of_range;
  const auto radians = [](const std::optional<double>& degrees) -> std::optional<double> {
    if (!degrees) return std::nullopt;
    return *degrees * base::kRadiansPerDegree;
  };
  CompassSample compass;
  if (data->heading_deg) compass.heading_rad = base::as_heading(*data->heading_deg * base::kRadiansPerDegree);
  compass.pitch_rad = radians(data->pitch_deg);
  compass.roll_rad = radians(data->roll_deg);
  compass.field_body_uT = vector_of_axes(data->field_uT);
  compass.temperature_C = data->temperature_C;
  if (data->distorted.value_or(false)) compass.error = protocols::tcm2::error::kDistortion;
  if (!compass.heading_rad && !compass.field_body_uT && !compass.pitch_rad && !compass.roll_rad) {
    return Verdict::ignored;
  }
  hand_over(compass, receiver);
  const auto acceleration_m_s2 = vector_of_axes(data->acceleration_m_s2);
  if (!acceleration_m_s2) return Verdict::used;
  if (const auto force_m_s2 = specific_force(*acceleration_m_s2, compass)) {
    ImuSample imu;
    imu.specific_force_m_s2 = force_m_s2;
    hand_over(imu, receiver, false);
  }
  return Verdict::used;
}

namespace {

constexpr std::int64_t kPniAnswer_ns = 500 * base::kMillisecond_ns;
/// After a command without an answer: the time in which the device carries it out.
constexpr std::int64_t kPniObeys_ns = 50 * base::kMillisecond_ns;
constexpr int kPniAttempts = 3;
constexpr std::int64_t kPniStopped_ns = 3 * base::kSecond_ns;
constexpr std::int64_t kPniRest_ns = 10 * base::kSecond_ns;
constexpr double kUsualPniRate_Hz = 10;

constexpr trax::Component kComponents[] = {
    trax::Component::heading,        trax::Component::pitch,          trax::Component::roll,
    trax::Component::field_x,        trax::Component::field_y,        trax::Component::field_z,
    trax::Component::acceleration_x, trax::Component::acceleration_y, trax::Component::acceleration_z,
    trax::Component::temperature,    trax::Component::distortion};

constexpr std::uint8_t number_of(trax::FrameNumber number) { return static_cast<std::uint8_t>(number); }

bool is_number(const protocols::Frame& frame, std::uint8_t number) {
  return frame.bytes.size() >= trax::kOverhead && frame.bytes[2] == number;
}

/// PNI TRAX, TCM3 and Prime (ICD section 11): stops the output, asks who is there, sets magnetic north, degrees
/// and byte order, the interval and the components, and starts continuous output. A device that sends nothing then
/// is polled. Nothing is saved in the device. Begins anew when the data stop.
class StartUpPni final : public StartUp {
 public:
  explicit StartUpPni(const config::PortSettings& settings)
      : rate_Hz_(settings.rate_Hz > 0 ? settings.rate_Hz : kUsualPniRate_Hz) {}

 private:
  struct Command {
    std::vector<std::uint8_t> bytes;
    std::uint8_t answer = 0;  ///< number of the frame that answers it; 0: none does
    std::string_view name{};
  };

  /// The first command also ends a frame that was cut off: the device has no other sign of where one begins.
  [[nodiscard]] std::vector<Command> commands(bool polled) const {
    using trax::FrameNumber;
    using trax::Setting;
    constexpr auto kDone = number_of(FrameNumber::set_config_done);
    std::vector<Command> commands{
        {trax::encode_frame(FrameNumber::stop_continuous), 0, "stop"},
        {trax::encode_frame(FrameNumber::get_module_info), number_of(FrameNumber::module_info), "GetModInfo"},
        {trax::encode_setting(Setting::true_north, 0), kDone, "magnetic north"},
        {trax::encode_setting(Setting::mils, 0), kDone, "degrees"},
        {trax::encode_setting(Setting::big_endian, 1), kDone, "byte order"},
        {trax::encode_acquisition({polled, polled ? 0 : 1 / rate_Hz_}), number_of(FrameNumber::acquisition_done),
         "acquisition"},
        {trax::encode_components(kComponents), 0, "components"}};
    if (!polled) commands.push_back({trax::encode_frame(FrameNumber::start_continuous), 0, "start"});
    return commands;
  }

  Script script() override {
    const std::int64_t stopped_ns = stopped_after_ns(rate_Hz_, kPniStopped_ns);
    for (bool polled = false;;) {
      unanswered_.clear();
      bool is_there = true;
      for (const Command& command : commands(polled)) {
        enter("configuring: " + std::string(command.name));
        if (command.answer == 0) {
          co_await send(command.bytes, kPniObeys_ns);
          continue;
        }
        const bool answered =
            co_await ask(command.bytes, kPniAttempts, kPniAnswer_ns,
                         [&command](const protocols::Frame& frame) { return is_number(frame, command.answer); });
        is_there = answered || command.answer != number_of(trax::FrameNumber::module_info);
        if (!is_there) break;
        if (!answered) note(unanswered_, std::string(command.name));
      }
      if (!is_there) {
        ++fruitless_;
        enter("no answer: trying again every 10 s");
        co_await wait(kPniRest_ns);
        polled = false;
        continue;
      }
      enter("configured, waiting for data");
      std::int64_t data_ns = now_ns();  // the newest came, or was first waited for
      const auto is_data = [this, polled, &data_ns](const protocols::Frame& frame) {
        if (!is_number(frame, number_of(trax::FrameNumber::data))) return false;
        if (!in_service()) enter(polled ? "running, polled" : "running", true);
        fruitless_ = 0;
        data_ns = now_ns();
        return !polled;  // polls keep their beat
      };
      while (now_ns() - data_ns < stopped_ns) {
        if (polled) {
          co_await ask(trax::encode_frame(trax::FrameNumber::get_data), 1, std::llround(1e9 / rate_Hz_), is_data);
        } else {
          co_await wait(stopped_ns, is_data);
        }
      }
      if (!in_service()) ++fruitless_;
      // Continuous output that never began may be a mode that this device does not have.
      polled = !in_service() && !polled;
    }
  }
  [[nodiscard]] std::string remark() const override { return attempt(); }

  double rate_Hz_;
};

}  // namespace

std::unique_ptr<StartUp> start_pni(const config::PortSettings& settings) {
  return std::make_unique<StartUpPni>(settings);
}

}  // namespace navcal::instruments
