// SPDX-License-Identifier: Apache-2.0
#include "tests/instruments/tcm2_calibration_bench.h"

#include <cmath>
#include <numbers>

namespace navcal::instruments::test {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

sim::Tcm2::Options in_service() {
  sim::Tcm2::Options options;
  options.go_at_power_on = true;
  return options;
}

config::PortSettings calibrated_compass() {
  config::PortSettings port;
  port.name = "calibrated_compass";
  port.protocol = protocols::Protocol::tcm2;
  port.rate_Hz = 10;
  return port;
}

}  // namespace

sim::State Turning::at(std::int64_t t_ns) const {
  const double t_s = static_cast<double>(t_ns % (3600 * base::kSecond_ns)) * 1e-9;
  sim::State state;
  state.specific_force_m_s2 = {0, 0, -sim::kGravity_m_s2};
  state.euler_rad = {0.3 * std::sin(t_s / 3), 0.25 * std::sin(t_s / 4), rate_deg_s_ * t_s * kRadians};
  return state;
}

Tcm2CalibrationBench::Tcm2CalibrationBench(double rate_deg_s, std::int64_t longest_ns)
    : made(make_compass_calibration(calibrated_compass(), longest_ns)), motion_(rate_deg_s),
      device_(in_service(), motion_) {
  device_.power_on(now_ns);
  run_for(base::kSecond_ns);  // its banner, and the first words
}

void Tcm2CalibrationBench::run_for(std::int64_t duration_ns, const std::function<void()>& each) {
  const bool under_way = dialogue.busy();
  for (const std::int64_t end_ns = now_ns + duration_ns; now_ns < end_ns; now_ns += base::kMillisecond_ns) {
    each();
    emissions_.clear();
    device_.advance(now_ns, emissions_);
    for (const auto& emission : emissions_) {
      const std::string line(emission.bytes.begin(), emission.bytes.end());
      if (line_passes(line)) late_.push_back({now_ns + delay_ns, line});
    }
    deliver();
    while (const auto bytes = dialogue.next(now_ns)) {
      sent.emplace_back(bytes->begin(), bytes->end());
      if (command_passes(sent.back())) device_.on_bytes(now_ns, *bytes);
    }
    if (under_way && !dialogue.busy()) return;
  }
}

void Tcm2CalibrationBench::deliver() {
  while (!late_.empty() && late_.front().due_ns <= now_ns) {
    const std::string line = late_.front().line;
    late_.erase(late_.begin());
    parser_.feed({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()},
                 [&](const protocols::Frame& frame) {
                   if (frame.id == protocols::tcm2::kWord) last_word_ns_ = now_ns;
                   dialogue.on_frame(frame, now_ns);
                 });
  }
}

std::string Tcm2CalibrationBench::transcript() const {
  std::string text;
  for (const std::string& command : sent) text += command.substr(0, command.size() - 1) + ' ';
  return text;
}

bool Tcm2CalibrationBench::words_flow() {
  run_for(2 * base::kSecond_ns);
  return now_ns - last_word_ns_ < base::kSecond_ns;
}

}  // namespace navcal::instruments::test
