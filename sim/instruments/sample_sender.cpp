// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/sample_sender.h"

#include <string>

#include "protocols/samples_line.h"

namespace navcal::sim {
namespace {

constexpr double kSender_Hz = 5;
constexpr std::uint64_t kTicksPerTemperature = 5;
constexpr std::int64_t kSenderTimeStd_ns = 1'000'000;

using protocols::samples_line::LineWriter;

LineWriter line_at(std::string_view class_name, std::int64_t t_ns) {
  LineWriter line(class_name);
  line.seconds("time", t_ns).seconds("time_std", kSenderTimeStd_ns);
  return line;
}

}  // namespace

SampleSender::SampleSender(const Options& options, const Motion& motion)
    : LineDevice(options.baud), options_(options), motion_(motion), noise_(options.seed) {}

void SampleSender::power_on(std::int64_t t_ns) { ticks_ = Ticks(t_ns, 1 / kSender_Hz, 0); }

void SampleSender::act(std::int64_t t_ns, std::vector<Emission>& out) {
  const State state = motion_.at(t_ns);
  Vector3 velocity_m_s = state.velocity_body_m_s;
  for (double& component : velocity_m_s) component += noise_.normal(options_.velocity_noise_m_s);
  std::string lines = line_at("DVL", t_ns)
                          .text("frame", "body")
                          .vector("bottom_velocity_m_s", velocity_m_s)
                          .number("bottom_velocity_std_m_s", options_.velocity_noise_m_s)
                          .finish();
  lines += line_at("DEPTH", t_ns)
               .number("depth_m", state.position_m[2] + noise_.normal(options_.depth_noise_m))
               .number("depth_std_m", options_.depth_noise_m)
               .finish();
  if (sent_++ % kTicksPerTemperature == 0) {
    lines += line_at("SENSOR", t_ns)
                 .text("quantity", "temperature")
                 .text("unit", "degC")
                 .number("value", state.water_temperature_C + noise_.normal(options_.temperature_noise_C))
                 .finish();
  }
  send(t_ns, {lines.begin(), lines.end()}, out);
  ticks_.pass();
}

}  // namespace navcal::sim
