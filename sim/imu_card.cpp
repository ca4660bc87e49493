#include "sim/imu_card.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::sim {
namespace {

namespace wire = protocols::imu_card;
constexpr double kPeriod_s = 0.05;
constexpr double kFullScale = 65520;
constexpr double kCountsPer_mV = 16;

}  // namespace

ImuCard::ImuCard(const Options& options, const Motion& motion)
    : options_(options), motion_(motion), noise_(options.seed) {}

void ImuCard::power_on(std::int64_t t_ns) {
  ticks_ = Ticks(t_ns, kPeriod_s, options_.clock_ppm);
  sequence_ = 0;
  for (double& bias : bias_deg_s_) bias = noise_.normal(options_.turn_on_bias_deg_s);
}

void ImuCard::advance(std::int64_t t_ns, std::vector<Emission>& out) {
  for (; ticks_.next_ns() <= t_ns; ticks_.pass()) {
    const std::int64_t sent_ns = ticks_.next_ns();
    const auto frame = wire::encode_record(measure(sent_ns - std::llround(options_.latency_s * 1e9)));
    line_.put(sent_ns, options_.baud, {frame.begin(), frame.end()}, out);
  }
}

wire::Record ImuCard::measure(std::int64_t t_ns) {
  const State state = motion_.at(t_ns);
  const auto gyro = [&](std::size_t bias, std::size_t axis) {
    return state.rate_rad_s[axis] * 180 / std::numbers::pi + bias_deg_s_[bias] +
           noise_.normal(options_.rate_noise_deg_s);
  };
  const auto force_g = [&](std::size_t axis) {
    return (state.specific_force_m_s2[axis] + noise_.normal(options_.force_noise_m_s2)) / kGravity_m_s2;
  };
  const std::array<double, 8> signals{
      gyro(0, 0), gyro(1, 2), gyro(2, 1), gyro(3, 2),
      force_g(0), force_g(1), force_g(2), state.position_m[2] + noise_.normal(options_.depth_noise_m)};
  wire::Record record;
  record.sequence = sequence_++;
  record.status = status_;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const double reading =
        std::round(kCountsPer_mV * (options_.card.zero_mV[i] + options_.card.scale[i] * signals[i]));
    if (reading < 0 || reading > kFullScale) record.status |= wire::over_range;
    record.raw[i] = static_cast<std::uint16_t>(std::clamp(reading, 0.0, kFullScale));
  }
  return record;
}

}  // namespace navcal::sim
