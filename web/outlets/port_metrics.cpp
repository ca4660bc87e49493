// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/port_metrics.h"

#include <array>
#include <nlohmann/json.hpp>

#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

using nlohmann::json;
using Ports = std::vector<const json*>;

constexpr std::array kPortStates{"running", "silent", "no_frames", "noisy", "away", "off"};

struct PortMember {
  const char* key;
  const char* name;
  const char* help;
};

constexpr std::array kPortCounters{
    PortMember{"opened", "navcald_port_opened_total", "Times that the port was opened."},
    PortMember{"bytes", "navcald_port_bytes_total", "Bytes received."},
    PortMember{"skipped", "navcald_port_skipped_bytes_total", "Bytes received that belong to no frame."},
    PortMember{"frames", "navcald_port_frames_total", "Intact frames."},
    PortMember{"samples", "navcald_port_samples_total", "Samples made of the frames."},
    PortMember{"bad", "navcald_port_bad_checksums_total", "Frames with a wrong checksum."},
    PortMember{"unused", "navcald_port_unused_frames_total", "Intact frames that gave no sample."},
    PortMember{"out_of_range", "navcald_port_out_of_range_frames_total", "Intact frames with impossible content."},
    PortMember{"gaps", "navcald_port_gaps_total", "Incomplete frames that were given up after a silence."},
    PortMember{"lost", "navcald_port_lost_frames_total", "Frames missing by sequence number or clock."},
    PortMember{"repeated", "navcald_port_repeated_frames_total", "Frames that came twice."}};

/// Bounds of the histogram in seconds: 1, 2, 4, ... microseconds. The daemon's last bucket has none.
constexpr std::size_t kLatencyBounds = 20;

std::array<double, kLatencyBounds> latency_bounds_s() {
  std::array<double, kLatencyBounds> bounds{};
  double bound_us = 1;
  for (double& bound : bounds) {
    bound = bound_us / 1e6;
    bound_us *= 2;
  }
  return bounds;
}

void append_port_states(Exposition& out, const Ports& ports) {
  out.metric("navcald_port_state", Exposition::Type::gauge, "1 for the state in which the port is, 0 for others.");
  for (const json* port : ports) {
    const std::string state = text_in(*port, "state"), device = text_in(*port, "device");
    if (state.empty()) continue;
    for (const char* known : kPortStates)
      out.sample({{"device", device}, {"state", known}}, state == known ? 1.0 : 0.0);
  }
}

void append_port_clocks(Exposition& out, const Ports& ports) {
  const auto gauge = [&](const char* name, const char* help, auto&& value) {
    out.metric(name, Exposition::Type::gauge, help);
    for (const json* port : ports)
      out.sample({{"device", text_in(*port, "device")}}, value(member_of(*port, "clock")));
  };
  constexpr double kPpm = 1e-6;
  gauge("navcald_port_clock_locked", "1 when the clock of the device is known.",
        [](const json& clock) { return flag_in(clock, "locked"); });
  gauge("navcald_port_period_seconds", "Period of the frames, as it was learnt.",
        [](const json& clock) { return number_in(clock, "period_s"); });
  gauge("navcald_port_jitter_seconds", "Scatter of the arrivals about the clock of the device.",
        [](const json& clock) { return number_in(clock, "jitter_s"); });
  gauge("navcald_port_clock_skew_ratio", "Rate of the clock of the device, less one.",
        [](const json& clock) { return scaled(number_in(clock, "skew_ppm"), kPpm); });
  gauge("navcald_port_clock_skew_std_ratio", "Standard error of navcald_port_clock_skew_ratio.",
        [](const json& clock) { return scaled(number_in(clock, "skew_std_ppm"), kPpm); });
  out.metric("navcald_port_clock_resets_total", Exposition::Type::counter,
             "Times that the clock of the device was learnt anew.");
  for (const json* port : ports)
    out.sample({{"device", text_in(*port, "device")}}, number_in(member_of(*port, "clock"), "resets"));
}

void append_port_latencies(Exposition& out, const Ports& ports) {
  static const auto kBounds_s = latency_bounds_s();
  out.metric("navcald_port_latency_seconds", Exposition::Type::histogram,
             "Time from the arrival of a sample's bytes to the status socket.");
  for (const json* port : ports) {
    const json& list = member_of(*port, "latency_log2_us");
    if (!list.is_array()) continue;
    std::vector<std::uint64_t> counts;
    for (const json& count : list) counts.push_back(count.is_number_unsigned() ? count.get<std::uint64_t>() : 0);
    out.histogram({{"device", text_in(*port, "device")}}, kBounds_s, counts, number_in(*port, "latency_sum_s"));
  }
}

}  // namespace

void append_ports(Exposition& out, const std::vector<json>& health_parts) {
  Ports ports;
  for (const json& part : health_parts) {
    for (const json& port : member_of(part, "ports")) {
      if (port.is_object() && !text_in(port, "device").empty()) ports.push_back(&port);
    }
  }
  append_port_states(out, ports);
  for (const PortMember& member : kPortCounters) {
    out.metric(member.name, Exposition::Type::counter, member.help);
    for (const json* port : ports)
      out.sample({{"device", text_in(*port, "device")}}, number_in(*port, member.key));
  }
  append_port_clocks(out, ports);
  append_port_latencies(out, ports);
}

}  // namespace navcal::web
