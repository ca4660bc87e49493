// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/vectornav.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "base/durations.h"
#include "protocols/decimal.h"
#include "sim/rotation.h"

namespace navcal::sim {
namespace {

namespace vn = protocols::vectornav;

constexpr std::int64_t kVnReply_ns = 5 * base::kMillisecond_ns;
constexpr double kSensorRate_Hz = 800;
constexpr double kAir_Pa = 101'300;
constexpr int kYmr = 14;
constexpr std::size_t kLineLength = 120, kBinaryLength = 84;
constexpr std::uint8_t kInvalidParameter = 7, kInvalidRegister = 8, kInsufficientBaud = 12;

}  // namespace

void VectorNav::power_on(std::int64_t t_ns) {
  forget();
  electronics_.power_on(t_ns, motion_);
  powered_ns_ = t_ns;
  line_type_ = kYmr;
  line_rate_Hz_ = 40;
  output_ = "0,0,00";
  sends_binary_ = sends_errors_ = false;
  restart_ticks(t_ns, line_rate_Hz_);
}

void VectorNav::restart_ticks(std::int64_t t_ns, double rate_Hz) {
  ticks_ = Ticks(t_ns, 1 / rate_Hz, options_.clock_ppm);
}

std::int64_t VectorNav::next_act_ns() const {
  return sends_binary_ || line_type_ != 0 ? ticks_.next_ns() : kNever_ns;
}

void VectorNav::obey(std::int64_t t_ns, const protocols::Frame& command) {
  const auto wanted = vn::decode_register(command.bytes);
  if (!wanted) return;
  const std::uint8_t error = wanted->write ? set(t_ns, *wanted) : std::uint8_t{0};
  const std::string value = value_of(wanted->number);
  const bool known = !value.empty();
  answer(t_ns + kVnReply_ns, error != 0 ? vn::encode_error(error)
                             : known    ? vn::encode_register({wanted->write, wanted->number, value})
                                        : vn::encode_error(kInvalidRegister));
}

std::string VectorNav::value_of(unsigned number) const {
  switch (number) {
    case vn::kModel: return "VN-100T-EMU";
    case vn::kFirmware: return options_.has_errors ? "2.1.0.0" : "1.1.0.0";
    case vn::kAsyncType: return std::to_string(line_type_);
    case vn::kAsyncRate: return std::to_string(line_rate_Hz_);
    case vn::kBinaryOutput1: return output_;
    default: return {};
  }
}

std::uint8_t VectorNav::set(std::int64_t t_ns, const vn::Register& wanted) {
  if (wanted.number == vn::kBinaryOutput1) return set_output(t_ns, wanted.values);
  const auto value = protocols::integer<int>(wanted.values);
  if (wanted.number == vn::kAsyncType) {
    if (!value || (*value != 0 && *value != kYmr)) return kInvalidParameter;
    line_type_ = *value;
  } else if (wanted.number == vn::kAsyncRate) {
    if (!value || *value < 1 || *value > 200 || 200 % *value != 0) return kInvalidParameter;
    if (static_cast<double>(kLineLength * 10) * *value > options_.baud) return kInsufficientBaud;
    line_rate_Hz_ = *value;
  } else {
    return kInvalidRegister;
  }
  if (!sends_binary_) restart_ticks(t_ns, line_rate_Hz_);
  return 0;
}

/// Takes the two selections of fields that the start-up asks for.
std::uint8_t VectorNav::set_output(std::int64_t t_ns, const std::string& values) {
  if (options_.is_bare) return kInvalidRegister;
  const std::size_t first = values.find(','), second = values.find(',', first + 1);
  if (first == std::string::npos || second == std::string::npos) return kInvalidParameter;
  const auto port = protocols::integer<int>(values.substr(0, first));
  const auto divisor = protocols::integer<int>(values.substr(first + 1, second - first - 1));
  const std::string fields = values.substr(second + 1);
  const bool errors = fields == "11,0529,0100";
  if (!port || *port < 0 || *port > 3 || !divisor || *divisor < 1 || (!errors && fields != "01,0529") ||
      (errors && !options_.has_errors))
    return kInvalidParameter;
  const double rate_Hz = kSensorRate_Hz / *divisor;
  if (static_cast<double>(kBinaryLength * 10) * rate_Hz > options_.baud) return kInsufficientBaud;
  output_ = values;
  sends_binary_ = *port == options_.port || *port == 3;
  sends_errors_ = errors;
  restart_ticks(t_ns, sends_binary_ ? rate_Hz : line_rate_Hz_);
  return 0;
}

vn::Reading VectorNav::measure(std::int64_t sent_ns) {
  const std::int64_t t_ns = sent_ns - std::llround(options_.timing.latency_s * 1e9);
  const State state = motion_.at(t_ns);
  vn::Reading reading;
  const double own_ns = static_cast<double>(t_ns - powered_ns_) / (1 + options_.clock_ppm * 1e-6);
  reading.since_startup_ns = static_cast<std::uint64_t>(std::max(0.0, own_ns));
  reading.rate_rad_s = noisy(state.rate_rad_s, options_.rate_noise_rad_s);
  reading.acceleration_m_s2 = noisy(state.specific_force_m_s2, options_.force_noise_m_s2);
  const Vector3 field_uT = transpose(R_world_from_body(state.euler_rad)) * state.field_world_uT;
  reading.field_uT = noisy(field_uT, options_.field_noise_uT);
  const double declination_rad = std::atan2(state.field_world_uT[1], state.field_world_uT[0]);
  const double yaw_rad = state.euler_rad[2] - declination_rad + noise_.normal(options_.heading_noise_rad);
  const double pitch_rad = state.euler_rad[1] + noise_.normal(options_.tilt_noise_rad);
  const double roll_rad = state.euler_rad[0] + noise_.normal(options_.tilt_noise_rad);
  const double limit_deg = 90;
  reading.yaw_pitch_roll_deg = {base::wrapped(yaw_rad) * base::kDegreesPerRadian,
                                std::clamp(pitch_rad * base::kDegreesPerRadian, -limit_deg, limit_deg),
                                base::wrapped(roll_rad) * base::kDegreesPerRadian};
  reading.temperature_C = electronics_.temperature_C(t_ns, motion_);
  reading.pressure_Pa = kAir_Pa;
  if (sends_errors_) {
    reading.yaw_pitch_roll_std_deg = {options_.heading_noise_rad * base::kDegreesPerRadian,
                                      options_.tilt_noise_rad * base::kDegreesPerRadian,
                                      options_.tilt_noise_rad * base::kDegreesPerRadian};
  }
  return reading;
}

void VectorNav::act(std::int64_t now_ns, std::vector<Emission>& out) {
  const vn::Reading reading = measure(now_ns);
  send(now_ns, sends_binary_ ? vn::encode_binary(reading) : vn::encode_line(reading), out);
  ticks_.pass();
}

}  // namespace navcal::sim
