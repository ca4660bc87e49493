// SPDX-License-Identifier: Apache-2.0
#include "daemon/health.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/angles.h"
#include "config/load.h"
#include "daemon/json_text.h"
#include "record/log/log_encoder.h"

namespace navcal::daemon {
namespace {

void text(std::string& out, std::string_view key, std::string_view value) {
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"{}\":"), key);
  append_quoted(out, value);
}

void number(std::string& out, std::string_view key, double value, int decimals) {
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"{}\":"), key);
  append_shortest(out, value, decimals);
}

void append_alarms(std::string& out, const Health& health) {
  out += ",\"alarms\":[";
  bool first = true;
  for (const auto& alarm : health.alarms) {
    if (!first) out += ',';
    first = false;
    fmt::format_to(std::back_inserter(out), FMT_STRING("{{\"alarm\":\"{}\""), name_of(alarm.alarm));
    const std::string_view beside = place_beside_ports(alarm.port);
    text(out, "device", beside.empty() ? health.ports[alarm.port]->settings().name : beside);
    out += '}';
  }
  out += ']';
}

void append_clock(std::string& out, const instruments::ClockState& clock) {
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"clock\":{{\"locked\":{}"), clock.locked);
  text(out, "timing", instruments::name_of(clock.timing));
  number(out, "period_s", clock.period_s, 9);
  number(out, "skew_ppm", clock.skew_ppm, 3);
  number(out, "skew_std_ppm", clock.skew_std_ppm, 3);
  number(out, "jitter_s", clock.jitter_s, 9);
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"resets\":{}}}"), clock.resets);
}

/// Appends the histogram without the empty buckets at the end.
void append_latency(std::string& out, const LatencyHistogram& latency) {
  const auto& buckets = latency.buckets();
  std::size_t used = buckets.size();
  while (used > 0 && buckets[used - 1] == 0) --used;
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"latency_log2_us\":[{}]"),
                 fmt::join(buckets.begin(), buckets.begin() + static_cast<std::ptrdiff_t>(used), ","));
  number(out, "latency_sum_s", static_cast<double>(latency.sum_ns()) * 1e-9, 6);
}

void append_port(std::string& out, const PortSession& port, const pipeline::PortStatistics& statistics) {
  out += "{\"device\":";
  append_quoted(out, port.settings().name);
  text(out, "protocol", protocols::name_of(port.settings().protocol));
  if (!port.settings().serial_number.empty()) text(out, "serial_number", port.settings().serial_number);
  text(out, "state", name_of(port.state()));
  text(out, "reason", port.reason());
  if (const auto& open = port.open_port()) {
    text(out, "path", open->path);
    text(out, "low_latency", open->low_latency);
  }
  if (const auto start_up = port.start_up_state(); !start_up.empty()) text(out, "start_up", start_up);
  const auto& bytes = statistics.bytes;
  fmt::format_to(
      std::back_inserter(out),
      FMT_STRING(",\"opened\":{},\"bytes\":{},\"frames\":{},\"samples\":{},\"bad\":{},\"skipped\":{},\"held\":{},"
                 "\"out_of_range\":{},\"gaps\":{},\"lost\":{},\"repeated\":{}"),
      port.times_opened(), bytes.bytes, bytes.frames, statistics.samples, bytes.bad_checksum, bytes.skipped_bytes,
      statistics.held_bytes, statistics.out_of_range, statistics.silences, statistics.lost, statistics.repeated);
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"unused\":{}"), statistics.unused.total());
  text(out, "unused_kinds", statistics.unused.words());
  append_clock(out, statistics.clock);
  append_latency(out, port.latency());
  out += '}';
}

void append_log(std::string& out, bool enabled, const DiskState& log) {
  text(out, "state", enabled ? name_of(log.state) : "off");
  text(out, "reason", log.reason);
  text(out, "file", log.file);
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"bytes\":{},\"synced\":{},\"queued\":{},\"lost\":{}"),
                 log.file_bytes, log.synced_bytes, log.queued_bytes, log.dropped);
}

/// The ports that serve, of those that have delivered, and what the headings are counted from.
void append_sources(std::string& out, const Health& health) {
  out += ",\"sources\":{";
  const auto sources = health.pipeline->sources();
  bool first = true;
  for (const config::Role role : config::kRoles) {
    if (!sources[role]) continue;
    if (!first) out += ',';
    first = false;
    fmt::format_to(std::back_inserter(out), FMT_STRING("\"{}\":"), config::name_of(role));
    append_quoted(out, health.ports[*sources[role]]->settings().name);
  }
  out += '}';
  if (!health.heading_source.empty()) text(out, "heading_source", health.heading_source);
  const pipeline::EarthField& field = health.pipeline->earth_field();
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"earth_field\":{{\"declination_source\":\"{}\""),
                 pipeline::name_of(field.declination_source));
  if (field.declination_source != pipeline::EarthField::Source::none)
    number(out, "declination", field.declination_rad * base::kDegreesPerRadian, 3);
  text(out, "size_source", pipeline::name_of(field.size_source));
  if (field.size_source != pipeline::EarthField::Source::none) {
    number(out, "size_uT", field.size_uT, 3);
    number(out, "dip", field.dip_rad * base::kDegreesPerRadian, 3);
  }
  out += '}';
}

/// What a monitor counts besides: of the process, the clock and the battery.
void append_figures(std::string& out, const Health& health) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  out += ",\"process\":{\"version\":\"" NAVCAL_VERSION "\"";
  if (health.utc_ns) {
    out += ",\"started\":";
    append_utc(out, *health.utc_ns - std::llround(health.uptime_s * 1e9), 3);
  }
  number(out, "cpu_s", seconds(usage.ru_utime) + seconds(usage.ru_stime), 3);
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"most_resident_kB\":{}}}"), usage.ru_maxrss);
  const auto& mapping = health.pipeline->mapping();
  out += ",\"utc\":{\"source\":";
  append_quoted(out, pipeline::name_of(mapping.source));
  const bool bounded = mapping.bound_ns != pipeline::UtcMapping::kUnknownBound;
  out += ",\"bound_s\":";
  bounded ? append_shortest(out, static_cast<double>(mapping.bound_ns) * 1e-9, 9)
          : static_cast<void>(out += "null");
  out += '}';
  const auto battery = health.pipeline->battery();
  if (!battery) return;
  out += ",\"battery\":{\"low\":";
  out += battery->low ? "true" : "false";
  if (battery->voltage_V) number(out, "voltage_V", *battery->voltage_V, 3);
  if (battery->current_A) number(out, "current_A", *battery->current_A, 3);
  if (battery->charge) {
    number(out, "charge_Ah", battery->charge->charge_Ah, 4);
    number(out, "charge_std_Ah", battery->charge->std_Ah, 4);
  }
  out += '}';
}

std::string beginning(const Health& health, std::size_t first, std::size_t last, std::size_t lines) {
  std::string out = "{\"class\":\"HEALTH\"";
  append_alarms(out, health);
  if (health.utc_ns) {
    out += ",\"time\":";
    append_utc(out, *health.utc_ns, 3);
  }
  if (!health.vehicle.empty()) out += ",\"vehicle\":" + health.vehicle;
  number(out, "uptime_s", health.uptime_s, 3);
  if (lines > 1) {
    fmt::format_to(std::back_inserter(out), FMT_STRING(",\"part\":{},\"parts\":{}"), first / kPortsPerHealth + 1,
                   lines);
  }
  append_sources(out, health);
  if (first == 0) append_figures(out, health);
  if (first == 0 && !health.motor.empty()) out += ",\"motor\":" + health.motor;
  if (first == 0 && !health.remote.empty()) out += ",\"remote\":" + health.remote;
  out += ",\"ports\":[";
  for (std::size_t i = first; i < last; ++i) {
    if (i > first) out += ',';
    append_port(out, *health.ports[i], health.pipeline->statistics(static_cast<std::uint16_t>(i)));
  }
  out += "],\"log\":{\"enabled\":";
  out += health.log_enabled ? "true" : "false";
  append_log(out, health.log_enabled, health.log);
  fmt::format_to(std::back_inserter(out),
                 FMT_STRING("}},\"clients\":{},\"client_queue_bytes\":{},\"client_dropped\":{}"), health.clients,
                 health.client_queue_bytes, health.client_dropped);
  return out;
}

}  // namespace

std::string vehicle_identity(const config::Settings& settings) {
  // A name is UTF-8, unlike the texts of devices, of which every byte has to be shown.
  nlohmann::ordered_json identity{{"config_crc32c", record::config_sum(config::to_toml(settings))}};
  if (!settings.vehicle.id.empty()) identity["id"] = settings.vehicle.id;
  if (!settings.vehicle.name.empty()) identity["name"] = settings.vehicle.name;
  return identity.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::vector<std::string> health_beginnings(const Health& health) {
  std::vector<std::string> lines;
  const std::size_t ports = health.ports.size();
  const std::size_t count = std::max<std::size_t>(1, (ports + kPortsPerHealth - 1) / kPortsPerHealth);
  for (std::size_t i = 0; i < count; ++i) {
    lines.push_back(beginning(health, i * kPortsPerHealth, std::min(ports, (i + 1) * kPortsPerHealth), count));
  }
  return lines;
}

void append_log_report(std::string& out, bool enabled, const DiskState& log,
                       const std::vector<std::string>& left_out) {
  out += "{\"class\":\"LOG\"";
  append_log(out, enabled, log);
  out += ",\"left_out\":[";
  append_quoted_list(out, left_out);
  out += "]}\r\n";
}

}  // namespace navcal::daemon
