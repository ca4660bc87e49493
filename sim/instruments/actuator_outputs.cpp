// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/actuator_outputs.h"

#include <fmt/format.h>

#include <charconv>
#include <string>

#include "protocols/checked_line.h"

namespace navcal::sim {
namespace {

constexpr std::int64_t kInterval_ns = 100'000'000;
constexpr auto kOutputsLatency_ns = static_cast<std::int64_t>(1e9 * config::kOutputsLatency_s);
constexpr std::size_t kFieldsOfALine = 8;
constexpr double kLow_us = 500, kHigh_us = 2500;

std::vector<std::uint8_t> output_line(std::string_view name, const std::vector<double>& pulses_us,
                                      std::size_t first) {
  std::string body(name);
  for (std::size_t i = first; i < first + kFieldsOfALine; ++i)
    body += i < pulses_us.size() ? fmt::format(",{:.0f}", pulses_us[i]) : ",";
  return protocols::checked_line(body);
}

/// The outputs of a sentence, at their places; empty when it is no such sentence or has a number that cannot be.
std::vector<std::optional<double>> outputs_of(const protocols::nmea::Sentence& sentence) {
  const bool is_second = sentence.address() == "PNCAP";
  if ((!is_second && sentence.address() != "PNCAO") || sentence.size() != kFieldsOfALine) return {};
  std::vector<std::optional<double>> outputs(kMostOutputs);
  for (std::size_t i = 0; i < kFieldsOfALine; ++i) {
    const std::string_view text = sentence[i];
    if (text.empty()) continue;
    double pulse_us = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), pulse_us);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    if (!(pulse_us >= kLow_us && pulse_us <= kHigh_us)) return {};
    outputs[i + (is_second ? kFieldsOfALine : 0)] = pulse_us;
  }
  return outputs;
}

}  // namespace

void ActuatorOutputs::power_on(std::int64_t t_ns) {
  parser_ = {};
  next_ns_ = t_ns + kOutputsLatency_ns;
  if (obey_) obey_(t_ns, std::vector<std::optional<double>>(kMostOutputs, 1500.0));
}

void ActuatorOutputs::on_bytes(std::int64_t t_ns, protocols::Bytes bytes) {
  parser_.feed(bytes, [&](const protocols::Frame& frame) {
    const auto outputs = outputs_of(protocols::nmea::Sentence(frame.bytes));
    if (obey_ && !outputs.empty()) obey_(t_ns, outputs);
  });
}

void ActuatorOutputs::advance(std::int64_t t_ns, std::vector<Emission>& out) {
  orders_.clear();
  motion_.take_outputs(t_ns - kOutputsLatency_ns, orders_);
  for (const OutputOrder& order : orders_) {
    const std::int64_t sent_ns = order.time_ns + kOutputsLatency_ns;
    line_.put(sent_ns, config::kOutputsBaud, output_line("PNCAO", order.pulses_us, 0), out);
    if (order.pulses_us.size() > kFieldsOfALine)
      line_.put(sent_ns, config::kOutputsBaud, output_line("PNCAP", order.pulses_us, kFieldsOfALine), out);
  }
  while (next_ns_ <= t_ns) next_ns_ += kInterval_ns;
}

}  // namespace navcal::sim
