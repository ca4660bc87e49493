// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/angles.h"
#include "base/durations.h"
#include "instruments/devices.h"
#include "protocols/vectornav_lines.h"

namespace navcal::instruments {

namespace {

namespace vn = protocols::vectornav;
using vn::Triple;

// Beyond what any model of the family measures: 2000 deg/s, 16 g, 8 gauss.
constexpr double kMaxRate_rad_s = 40, kMaxForce_m_s2 = 400, kMaxVnField_uT = 1000;
constexpr double kLeastInside_C = -60, kMostInside_C = 130, kMostInside_Pa = 200'000;
// Angles may be rounded up to their limit.
constexpr double kYawLimit_deg = 360.001, kPitchLimit_deg = 90.001, kRollLimit_deg = 180.001;

/// Absent, or finite and not beyond the limit.
bool is_absent_or_within(const std::optional<Triple>& values, double limit) {
  return !values || std::all_of(values->begin(), values->end(), [limit](double value) {
    return std::isfinite(value) && std::abs(value) <= limit;
  });
}

bool can_be(const vn::Reading& reading) {
  const auto& angles = reading.yaw_pitch_roll_deg;
  const bool angles_can_be =
      is_absent_or_within(angles, kYawLimit_deg) &&
      (!angles || (std::abs((*angles)[1]) <= kPitchLimit_deg && std::abs((*angles)[2]) <= kRollLimit_deg));
  const bool inside_can_be =
      (!reading.temperature_C ||
       (*reading.temperature_C >= kLeastInside_C && *reading.temperature_C <= kMostInside_C)) &&
      (!reading.pressure_Pa || (*reading.pressure_Pa >= 0 && *reading.pressure_Pa <= kMostInside_Pa));
  return angles_can_be && inside_can_be && is_absent_or_within(reading.rate_rad_s, kMaxRate_rad_s) &&
         is_absent_or_within(reading.raw_rate_rad_s, kMaxRate_rad_s) &&
         is_absent_or_within(reading.acceleration_m_s2, kMaxForce_m_s2) &&
         is_absent_or_within(reading.raw_acceleration_m_s2, kMaxForce_m_s2) &&
         is_absent_or_within(reading.field_uT, kMaxVnField_uT) &&
         is_absent_or_within(reading.raw_field_uT, kMaxVnField_uT) &&
         is_absent_or_within(reading.yaw_pitch_roll_std_deg, kYawLimit_deg);
}

std::optional<ImuSample> imu_of(const vn::Reading& reading) {
  ImuSample sample;
  sample.rate_rad_s = reading.rate_rad_s ? reading.rate_rad_s : reading.raw_rate_rad_s;
  sample.specific_force_m_s2 =
      reading.acceleration_m_s2 ? reading.acceleration_m_s2 : reading.raw_acceleration_m_s2;
  sample.temperature_C = reading.temperature_C;
  if (!sample.rate_rad_s && !sample.specific_force_m_s2) return std::nullopt;
  return sample;
}

std::optional<CompassSample> compass_of(const vn::Reading& reading) {
  CompassSample sample;
  sample.field_body_uT = reading.field_uT ? reading.field_uT : reading.raw_field_uT;
  if (const auto& angles = reading.yaw_pitch_roll_deg) {
    sample.heading_rad = base::as_heading((*angles)[0] * base::kRadiansPerDegree);
    sample.pitch_rad = (*angles)[1] * base::kRadiansPerDegree;
    sample.roll_rad = (*angles)[2] * base::kRadiansPerDegree;
    if (const auto& std_deg = reading.yaw_pitch_roll_std_deg) {
      sample.heading_std_rad = (*std_deg)[0] * base::kRadiansPerDegree;
      sample.tilt_std_rad = std::max((*std_deg)[1], (*std_deg)[2]) * base::kRadiansPerDegree;
    }
  }
  if (!sample.field_body_uT && !sample.heading_rad) return std::nullopt;
  return sample;
}

Verdict hand_over_reading(const vn::Reading& reading, Receiver& receiver) {
  if (!can_be(reading)) return Verdict::out_of_range;
  std::optional<std::int64_t> device_time_ns;
  if (reading.since_startup_ns) device_time_ns = static_cast<std::int64_t>(*reading.since_startup_ns);
  bool used = false;
  const auto give = [&](const Value& value) {
    receiver.on_measurement({.value = value, .device_time_ns = device_time_ns, .paces = !used});
    used = true;
  };
  if (const auto imu = imu_of(reading)) give(*imu);
  if (const auto compass = compass_of(reading)) give(*compass);
  // The gauge is inside the sensor: the pressure is that of the housing's air, and no depth.
  if (reading.pressure_Pa && used)
    give(ScalarSample{Text<24>("air pressure"), Text<16>("Pa"), *reading.pressure_Pa, std::nullopt});
  return used ? Verdict::used : Verdict::ignored;
}

}  // namespace

/// VectorNav VN-100, VN-200, VN-300: rates and specific force, attitude and field, and the air pressure inside the
/// sensor. Compensated values are preferred to uncompensated ones of the same message. Yaw is taken for magnetic,
/// as it is with the settings of the factory (ICD section 12).
Verdict read_vectornav(const protocols::Frame& frame, const config::PortSettings&, Receiver& receiver) {
  if (frame.id == vn::kBinary) {
    const auto reading = vn::decode_binary(frame.bytes);
    return reading ? hand_over_reading(*reading, receiver) : Verdict::ignored;
  }
  const auto reading = vn::decode_line(frame.bytes);
  return reading ? hand_over_reading(*reading, receiver) : Verdict::ignored;
}

namespace {

constexpr std::int64_t kVnAnswer_ns = 300 * base::kMillisecond_ns;
constexpr std::int64_t kVnStopped_ns = base::kSecond_ns;
constexpr std::int64_t kVnRest_ns = 10 * base::kSecond_ns;
constexpr int kVnAttempts = 3;
constexpr double kImuRate_Hz = 800;  // of which binary outputs are a whole part
constexpr double kVnUsualRate_Hz = 40;
constexpr std::uint8_t kInvalidChecksum = 3;

/// The common group with time since start-up, yaw, pitch and roll, rate, acceleration, and field with temperature
/// and pressure; and from the attitude group the standard deviations of yaw, pitch and roll.
constexpr std::string_view kWithErrors = "11,0529,0100";
/// Without the latter, which old firmware does not have.
constexpr std::string_view kWithoutErrors = "01,0529";

/// The nearest of the rates that register 7 takes.
int line_rate(double rate_Hz) {
  constexpr std::array<int, 11> kRates{1, 2, 4, 5, 10, 20, 25, 40, 50, 100, 200};
  return *std::min_element(kRates.begin(), kRates.end(),
                           [rate_Hz](int a, int b) { return std::abs(a - rate_Hz) < std::abs(b - rate_Hz); });
}

std::string words_of(const vn::Register& content) {
  const auto line = vn::encode_register(content);
  return {line.begin() + 1, std::find(line.begin(), line.end(), std::uint8_t{'*'})};
}

bool is_of_register(const protocols::Frame& frame) {
  const std::string_view id = frame.id.view();
  return id == "VNRRG" || id == "VNWRG" || id == "VNERR";
}

bool is_measurement(const protocols::Frame& frame) {
  return frame.id == vn::kBinary || (!is_of_register(frame) && vn::decode_line(frame.bytes));
}

std::vector<std::uint8_t> read_request(unsigned number) { return vn::encode_register({false, number, {}}); }

bool is_question_answered(const std::optional<vn::Register>& answer, unsigned number) {
  return answer && !answer->write && answer->number == number;
}

/// VectorNav (ICD section 12): turns the lines off (register 6) and binary output 1 on (register 75) at the first
/// serial port of the sensor, then at the second. A sensor that sends no binary messages is set to lines VNYMR
/// (registers 7 and 6). Registers are written in the sensor's memory only, which a loss of power clears. Begins
/// again when the messages stop.
class StartUpVectorNav final : public StartUp {
 public:
  explicit StartUpVectorNav(const config::PortSettings& settings);

 private:
  enum class Purpose : std::uint8_t { silence, binary, lines };
  struct Step {
    Purpose purpose{};
    protocols::vectornav::Register content;
    bool measures = false;  ///< when it is accepted, measurements must come
  };

  Script script() override {
    model_.clear();
    firmware_.clear();
    for (;;) {
      refused_.clear();
      unanswered_.clear();
      enter("asking for the model");
      for (const unsigned question : {vn::kModel, vn::kFirmware}) co_await send(read_request(question), 0);
      bool deaf = false;  // the sensor answered nothing: whatever comes is taken
      bool binary = false, came = false;
      for (std::size_t i = 0; i < steps_.size() && !deaf && !came; ++i) {
        const Step& step = steps_[i];
        enter("setting " + words_of(step.content));
        bool accepted = false;
        if (!co_await ask(vn::encode_register(step.content), kVnAttempts, kVnAnswer_ns,
                          [&](const protocols::Frame& frame) { return is_answer(frame, step, accepted); })) {
          note(unanswered_, words_of(step.content));
          deaf = i == 0;
        }
        if (!deaf && !(accepted && step.measures) && i + 1 < steps_.size()) continue;
        enter(deaf ? "no answers, waiting for measurements" : "settings sent, waiting for measurements");
        came = co_await wait(stopped_ns_, [&](const protocols::Frame& frame) {
          binary = frame.id == vn::kBinary;
          return is_measurement(frame) && (deaf || binary == (step.purpose == Purpose::binary));
        });
      }
      if (!came) {
        ++fruitless_;
        enter(fmt::format("no measurements come; trying again every 10 s, {} so far", fruitless_));
        co_await wait(kVnRest_ns);
        continue;
      }
      enter(binary ? "running on binary messages" : "running on lines", true);
      fruitless_ = 0;
      while (co_await wait(stopped_ns_, [binary](const protocols::Frame& frame) {
        return (frame.id == vn::kBinary) == binary && is_measurement(frame);
      }))
        continue;
    }
  }

  void on_any_frame(const protocols::Frame& frame) override {
    const auto answer = is_of_register(frame) ? vn::decode_register(frame.bytes) : std::nullopt;
    if (is_question_answered(answer, vn::kModel)) model_ = answer->values;
    if (is_question_answered(answer, vn::kFirmware)) firmware_ = answer->values;
  }

  bool is_answer(const protocols::Frame& frame, const Step& step, bool& accepted) {
    if (!is_of_register(frame)) return false;
    if (const auto error = vn::decode_error(frame.bytes)) {
      // A command that was damaged on the way is repeated when its answer is due.
      if (*error == kInvalidChecksum) return false;
      note(refused_, fmt::format("{} ({})", words_of(step.content), vn::meaning_of(*error)));
      return true;
    }
    const auto answer = vn::decode_register(frame.bytes);
    accepted = answer && answer->write && answer->number == step.content.number;
    return accepted;
  }

  [[nodiscard]] std::string remark() const override {
    return (model_.empty() ? "" : "; " + model_) + (firmware_.empty() ? "" : ", firmware " + firmware_);
  }

  std::vector<Step> steps_;
  std::int64_t stopped_ns_;       ///< measurements are taken to have stopped after this time without one
  std::string model_, firmware_;  ///< for people
};

}  // namespace

StartUpVectorNav::StartUpVectorNav(const config::PortSettings& settings) {
  const double rate_Hz = settings.rate_Hz > 0 ? settings.rate_Hz : kVnUsualRate_Hz;
  stopped_ns_ = stopped_after_ns(rate_Hz, kVnStopped_ns);
  const auto divisor = static_cast<int>(std::clamp(std::round(kImuRate_Hz / rate_Hz), 1.0, 65535.0));
  steps_.push_back({Purpose::silence, {true, vn::kAsyncType, "0"}, false});
  for (const std::string_view fields : {kWithErrors, kWithoutErrors}) {
    for (const char* port : {"1", "2"}) {
      steps_.push_back(
          {Purpose::binary, {true, vn::kBinaryOutput1, fmt::format("{},{},{}", port, divisor, fields)}, true});
    }
  }
  steps_.push_back({Purpose::lines, {true, vn::kAsyncRate, std::to_string(line_rate(rate_Hz))}, false});
  steps_.push_back({Purpose::lines, {true, vn::kAsyncType, "14"}, true});  // VNYMR
}

std::unique_ptr<StartUp> start_vectornav(const config::PortSettings& settings) {
  return std::make_unique<StartUpVectorNav>(settings);
}

}  // namespace navcal::instruments
