// SPDX-License-Identifier: Apache-2.0
#include "cli/live/watch_view.h"

#include <fmt/format.h>

#include <cmath>

#include "base/angles.h"
#include "base/append_format.h"
#include "cli/live/watch_text.h"

namespace navcal::cli {
namespace {

// Text of a NAV report, for people.

bool is_reckoned(const nlohmann::json& nav) { return text(nav, "position") == "reckoned"; }

double error_m(const nlohmann::json& nav) {
  return std::hypot(number(nav, "north_std_m"), number(nav, "east_std_m"));
}

/// Appends one line: position and its error, heading, speed, depth; while reckoned, time and way since the last
/// fix.
void append_navigation(std::string& out, const nlohmann::json& nav) {
  if (!nav.is_object()) return;
  base::append_format(out, "{:<12}", "navigation");
  if (text(nav, "position") == "none" || std::isnan(number(nav, "lat"))) {
    out += "no position before the first fix";
  } else {
    base::append_format(out, "{} {}, off by {} m", shown(nav, "lat", 7), shown(nav, "lon", 7),
                        shown(error_m(nav), 1));
  }
  base::append_format(out, ", heading {} deg true, {} m/s, depth {} m",
                      shown(number(nav, "heading_rad") * base::kDegreesPerRadian, 1), shown(nav, "speed_m_s", 2),
                      shown(nav, "depth_m", 2));
  if (!std::isnan(number(nav, "altitude_m"))) {
    base::append_format(out, ", {} m above the floor", shown(nav, "altitude_m", 1));
  }
  if (const auto lock = nav.find("bottom_lock"); lock != nav.end() && lock->is_boolean())
    out += lock->get<bool>() ? ", bottom lock" : ", NO BOTTOM LOCK";
  if (is_reckoned(nav)) {
    base::append_format(out, ", RECKONED: {} s and {} m since the last fix", shown(nav, "since_fix_s", 0),
                        shown(nav, "since_fix_m", 0));
  }
  if (const double within_s = number(nav, "surface_within_s"); is_reckoned(nav) && !std::isnan(within_s)) {
    out += within_s > 0 ? fmt::format(", surface within {} s", shown(within_s, 0)) : std::string(", SURFACE NOW");
    base::append_format(out, " (error at the next fix {} m)", shown(nav, "predicted_error_m", 0));
  }
  out += '\n';
}

/// The reckoned position in a few words; empty while there are fixes, or none yet.
std::string reckoned_words(const nlohmann::json& nav) {
  if (!nav.is_object() || !is_reckoned(nav)) return {};
  return fmt::format("reckoned {} {} off by {} m", shown(nav, "lat", 7), shown(nav, "lon", 7),
                     shown(error_m(nav), 1));
}

using Json = nlohmann::json;

using ByDevice = std::map<std::string, Json>;

/// The newest reports of a class.
const ByDevice& newest(const std::map<std::string, ByDevice>& reports, const std::string& kind) {
  static const ByDevice kNone;
  const auto found = reports.find(kind);
  return found == reports.end() ? kNone : found->second;
}

constexpr std::string_view kRed = "\x1b[1;37;41m", kPlain = "\x1b[0m";

std::string log_state(const Json& log) {
  if (!log.is_object()) return "log: -";
  std::string out = fmt::format("log: {}", text(log, "state"));
  if (const auto reason = text(log, "reason"); !reason.empty()) out += " (" + reason + ")";
  const auto file = text(log, "file");
  if (!file.empty()) out += " " + file.substr(file.rfind('/') + 1);
  base::append_format(out, ", {} MB, {} kB queued", shown(number(log, "bytes") * 1e-6, 1),
                      shown(number(log, "queued") * 1e-3, 0));
  if (number(log, "lost") > 0) base::append_format(out, ", {} records LOST", shown(log, "lost", 0));
  return out;
}

}  // namespace

void WatchView::clear() { *this = WatchView(); }

void WatchView::take(std::string_view line) {
  const Json report = Json::parse(line, nullptr, false);
  if (!report.is_object()) return;
  const std::string kind = text(report, "class");
  if (kind == "HEALTH") {
    take_health(report);
  } else if (kind == "TIME") {
    time_ = report;
  } else if (kind == "CALIB") {
    calibration_.take(report);
  } else if (kind == "NAV") {
    navigation_ = report;
  } else if (kind == "TPV" && text(report, "device") == "navigation") {
    return;  // NAV shows more
  } else if (!kind.empty()) {
    Json& last = last_[kind][text(report, "device")];
    if (kind != "ATT") last = Json::object();  // heading, field and rates of one device may come apart
    last.update(report);
  }
}

void WatchView::take_health(const Json& health) {
  alarms_ = health.value("alarms", Json::array());
  log_ = health.value("log", Json());
  sources_ = health.value("sources", Json());
  uptime_s_ = number(health, "uptime_s");
  dropped_ = number(health, "dropped");
  const Json ports = health.value("ports", Json::array());
  if (!ports.is_array()) return;
  for (const Json& port : ports) {
    if (!port.is_object()) continue;
    const std::string device = text(port, "device");
    const double frames = number(port, "frames");
    const auto before = ports_.find(device);
    // Reports on a change come soon after the regular one: too soon to tell a rate.
    const double elapsed_s = uptime_s_ - counted_at_s_[device];
    if (before != ports_.end() && elapsed_s < 0.5) {
      Json kept = port;
      kept["frames"] = before->second.value("frames", Json());
      before->second = std::move(kept);
      continue;
    }
    if (before != ports_.end()) frames_per_s_[device] = (frames - number(before->second, "frames")) / elapsed_s;
    counted_at_s_[device] = uptime_s_;
    ports_[device] = port;
  }
}

void WatchView::append_alarms(std::string& out, Colour colour) const {
  if (!alarms_.is_array()) return;
  for (const Json& alarm : alarms_) {
    if (!alarm.is_object()) continue;
    const auto words = fmt::format(" ALARM {} ({}) ", text(alarm, "alarm"), text(alarm, "device"));
    if (colour == Colour::ansi) {
      base::append_format(out, "{}{}{}\n", kRed, words, kPlain);
    } else {
      base::append_format(out, "{}\n", words);
    }
  }
}

/// "heading and field by compass, position by gps".
void WatchView::append_sources(std::string& out) const {
  if (!sources_.is_object()) return;
  std::string line, port;
  for (const char* role : {"heading", "field", "rates", "acceleration", "depth", "position", "velocity", "shaft",
                           "altitude", "bottom_velocity", "water_velocity"}) {
    const std::string server = text(sources_, role);
    if (server.empty()) continue;
    if (server == port) {
      line.insert(line.rfind(" by "), std::string(" and ") + role);
    } else {
      line += fmt::format("{}{} by {}", line.empty() ? "" : ", ", role, server);
      port = server;
    }
  }
  if (!line.empty()) base::append_format(out, "{}\n", line);
}

void WatchView::append_ports(std::string& out) const {
  base::append_format(out, "{:<12}{:<10}{:>9}{:>10}{:>8}{:>7}{:>9}{:>6}  {}\n", "port", "state", "frames/s",
                      "frames", "unused", "bad", "skipped", "lost", "reason");
  for (const auto& [device, port] : ports_) {
    const auto rate = frames_per_s_.find(device);
    base::append_format(out, "{:<12}{:<10}{:>9}{:>10}{:>8}{:>7}{:>9}{:>6}  {}\n", device, text(port, "state"),
                        shown(rate == frames_per_s_.end() ? NAN : rate->second, 1), shown(port, "frames", 0),
                        shown(port, "unused", 0), shown(port, "bad", 0), shown(port, "skipped", 0),
                        shown(port, "lost", 0), text(port, "reason"));
  }
}

void WatchView::append_attitude(std::string& out) const {
  for (const auto& [device, att] : newest(last_, "ATT")) {
    if (att.contains("heading")) {
      std::string words = text(att, "north");
      if (const std::string source = text(att, "heading_source"); !source.empty()) words += " by " + source;
      base::append_format(out, "{:<12}heading {} deg{}{}, pitch {}, roll {}, field {} uT, dip {} deg\n", device,
                          shown(att, "heading", 1), words.empty() ? "" : " ", words, shown(att, "pitch", 1),
                          shown(att, "roll", 1), shown(att, "mag_len", 2), shown(att, "dip", 1));
    }
    if (att.contains("depth")) {
      base::append_format(out, "{:<12}depth {} m, rates {} {} {} deg/s\n", device, shown(att, "depth", 2),
                          shown(att, "gyro_x", 2), shown(att, "gyro_y", 2), shown(att, "gyro_z", 2));
    }
  }
}

void WatchView::append_position(std::string& out) const {
  for (const auto& [device, tpv] : newest(last_, "TPV")) {
    const double mode = number(tpv, "mode");
    base::append_format(out, "{:<12}{} {} {}, {} m/s, course {}, {}\n", device,
                        mode >= 3   ? "3D"
                        : mode >= 2 ? "2D"
                                    : "no fix",
                        shown(tpv, "lat", 7), shown(tpv, "lon", 7), shown(tpv, "speed", 2), shown(tpv, "track", 1),
                        text(tpv, "time"));
  }
}

void WatchView::append_motor(std::string& out) const {
  for (const auto& [device, motor] : newest(last_, "MOTOR")) {
    base::append_format(out, "{:<12}{} rpm, {} A, fins", device, shown(motor, "rpm", 0),
                        shown(motor, "current_A", 2));
    const Json fins = motor.value("fins_rad", Json::array());
    for (const Json& fin : fins) {
      base::append_format(out, " {}",
                          shown(fin.is_number() ? fin.get<double>() * base::kDegreesPerRadian : NAN, 1));
    }
    out += " deg\n";
  }
}

void WatchView::append_battery(std::string& out) const {
  for (const auto& [device, battery] : newest(last_, "BATTERY")) {
    base::append_format(out, "{:<12}{} V, {} A, {} Ah (+-{}) or {} % left, {} min, {} m{}\n", "battery",
                        shown(battery, "voltage_V", 1), shown(battery, "current_A", 2),
                        shown(battery, "charge_Ah", 2), shown(battery, "charge_std_Ah", 2),
                        shown(battery, "charge_percent", 0), shown(number(battery, "time_left_s") / 60, 0),
                        shown(battery, "range_left_m", 0), battery.value("low", Json()) == true ? ", LOW" : "");
  }
}

void WatchView::append_log(std::string& out) const { base::append_format(out, "{}\n", log_state(log_)); }

void WatchView::append_time(std::string& out) const {
  if (!time_.is_object()) return;
  const double bound = number(time_, "bound");
  base::append_format(
      out, "UTC from {}, {}\n", text(time_, "source"),
      std::isfinite(bound) ? fmt::format("to within {:.6f} s", bound) : "to within an unknown bound");
}

std::string WatchView::page(Colour colour) const {
  std::string out;
  append_alarms(out, colour);
  append_ports(out);
  append_sources(out);
  append_attitude(out);
  append_position(out);
  append_navigation(out, navigation_);
  append_motor(out);
  append_battery(out);
  append_log(out);
  append_time(out);
  calibration_.append(out);
  if (dropped_ > 0) base::append_format(out, "this view missed {:.0f} reports\n", dropped_);
  return out;
}

std::string WatchView::line() const {
  std::string out;
  if (alarms_.is_array()) {
    for (const Json& alarm : alarms_) {
      if (alarm.is_object())
        base::append_format(out, "ALARM {} ({}); ", text(alarm, "alarm"), text(alarm, "device"));
    }
  }
  for (const auto& [device, port] : ports_) {
    const auto rate = frames_per_s_.find(device);
    base::append_format(out, "{} {} {}/s; ", device, text(port, "state"),
                        shown(rate == frames_per_s_.end() ? NAN : rate->second, 1));
  }
  for (const char* kind : {"ATT", "TPV"}) {
    for (const auto& [device, report] : newest(last_, kind)) {
      if (report.contains("heading")) base::append_format(out, "heading {}; ", shown(report, "heading", 1));
      if (report.contains("depth")) base::append_format(out, "depth {}; ", shown(report, "depth", 2));
      if (report.contains("lat")) {
        base::append_format(out, "{} {}; ", shown(report, "lat", 7), shown(report, "lon", 7));
      }
    }
  }
  if (const auto words = reckoned_words(navigation_); !words.empty()) base::append_format(out, "{}; ", words);
  if (!calibration_.name().empty()) base::append_format(out, "calibration {}; ", calibration_.name());
  return out + log_state(log_);
}

}  // namespace navcal::cli
