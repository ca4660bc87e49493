// SPDX-License-Identifier: Apache-2.0
#include "cli/live/arrivals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/append_format.h"
#include "cli/live/watch_text.h"

namespace navcal::cli {

void Arrivals::take(std::string_view line) {
  const nlohmann::json report = nlohmann::json::parse(line, nullptr, false);
  if (!report.is_object()) return;
  if (text(report, "class") == "RECORD" && text(report, "device") == port_) {
    const nlohmann::json sample = report.value("message", nlohmann::json());
    if (!sample.is_object() || std::isnan(number(sample, "arrival"))) return;  // an event
    Count& count = counts_[text(sample, "class")];
    if (count.samples++ == 0) count.first_s = number(sample, "arrival");
    count.last_s = number(sample, "arrival");
    count.time_std_s += number(sample, "time_std");
    count.age_s += number(sample, "arrival") - number(sample, "time");
  } else if (text(report, "class") == "HEALTH") {
    const nlohmann::json ports = report.value("ports", nlohmann::json::array());
    for (const nlohmann::json& port : ports) {
      if (!port.is_object() || text(port, "device") != port_) continue;
      state_ = port;
      health_ = report;
    }
  }
}

std::string Arrivals::came() const {
  if (!state_.is_object()) return fmt::format("port {}: navcald says nothing of it\n", port_);
  std::string out = fmt::format("port {}: {}", port_, text(state_, "state"));
  for (const auto& [key, head] :
       {std::pair("reason", "; "), std::pair("start_up", "; "), std::pair("unused_kinds", "; unused: ")}) {
    if (const std::string words = text(state_, key); !words.empty()) out += head + words;
  }
  out += '\n';
  for (const auto& [kind, count] : counts_) {
    const double ms_each = 1e3 / count.samples;
    base::append_format(out, "  {:<12}{:>7.1f} a second, times known to {} ms, {} ms old on arrival\n", kind,
                        (count.samples - 1) / std::max(count.last_s - count.first_s, 1e-9),
                        shown(count.time_std_s * ms_each, 1), shown(count.age_s * ms_each, 1));
  }
  std::string served;
  const nlohmann::json sources = health_.value("sources", nlohmann::json::object());
  for (const auto& [role, device] : sources.items()) {
    if (device != port_) continue;
    served += (served.empty() ? "" : ", ") + role;
    if (role == "heading" && text(health_, "heading_source") == "autopilot")
      served += " (the autopilot's own until a calibration is in force)";
  }
  if (!served.empty()) out += "  serves " + served + "\n";
  const nlohmann::json utc = health_.value("utc", nlohmann::json::object());
  const double bound_s = utc.is_object() ? number(utc, "bound_s") : NAN;
  base::append_format(out, "UTC: {}, bound of its error {} s\n", utc.is_object() ? text(utc, "source") : "unknown",
                      std::isfinite(bound_s) ? shown(bound_s, 3) : "unknown");
  return out;
}

std::string Arrivals::missing(const std::vector<ExpectedQuantity>& expected, const std::string& silent) const {
  const std::string away = state_.is_object() && text(state_, "state") == "away" ? text(state_, "reason") : "";
  if (!away.empty()) return "The port is not open: " + away + ". " + silent + "\n";
  if (counts_.empty()) return "No measurement arrives. " + silent + "\n";
  std::string out;
  const nlohmann::json sources = health_.value("sources", nlohmann::json::object());
  for (const auto& [role, todo] : expected) {
    if (!sources.contains(role)) base::append_format(out, "No {} arrives. {}\n", role, todo);
  }
  return out;
}

}  // namespace navcal::cli
