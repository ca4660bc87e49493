// SPDX-License-Identifier: Apache-2.0
#include "cli/remote_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "base/printable.h"
#include "cli/watch_text.h"

namespace navcal::cli {
namespace {

using RemoteObject = nlohmann::ordered_json;

std::string shown_or_dash(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : std::string("-");
}

RemoteObject json_or_null(const std::optional<double>& value) {
  return value ? RemoteObject(*value) : RemoteObject(nullptr);
}

template <std::size_t n>
RemoteObject json_list(const std::array<std::optional<double>, n>& values) {
  RemoteObject list = RemoteObject::array();
  for (const auto& value : values) list.push_back(json_or_null(value));
  return list;
}

std::string calibration_name(const link::CalibrationState& state) {
  return state.number == 0 ? std::string("none") : fmt::format("{}-{:08x}", state.number, state.hash);
}

std::string remote_verdict(const link::CalibrationState& state) {
  return state.verdict < link::kVerdictNames.size() ? std::string(link::kVerdictNames.at(state.verdict))
                                                    : "unknown";
}

}  // namespace

std::string words_of(const link::Report& r) {
  std::string out =
      fmt::format("heading {} {}  pitch {}  roll {}  depth {} m  speed {} m/s", shown_or_dash(r.heading_deg, 1),
                  r.is_north_true ? "true" : "magnetic", shown_or_dash(r.pitch_deg, 1),
                  shown_or_dash(r.roll_deg, 1), shown_or_dash(r.depth_m, 2), shown_or_dash(r.speed_m_s, 2));
  if (r.latitude_deg && r.longitude_deg)
    out += fmt::format("  at {:.6f} {:.6f} +- {} m", *r.latitude_deg, *r.longitude_deg,
                       shown_or_dash(r.position_std_m, 1));
  out +=
      fmt::format("  shaft {} rpm  fins {} {} {}", shown_or_dash(r.shaft_rpm, 0), shown_or_dash(r.fins_deg[0], 1),
                  shown_or_dash(r.fins_deg[1], 1), shown_or_dash(r.fins_deg[2], 1));
  if (r.battery_V) out += fmt::format("  battery {:.2f} V", *r.battery_V);
  if (r.battery_charge) out += fmt::format(" {:.0f} %", 100 * *r.battery_charge);
  out += r.holder.empty()
             ? std::string("  motor: nobody")
             : fmt::format("  motor: {} ({} s)", base::printable(r.holder), shown_or_dash(r.expires_in_s, 1));
  if (const auto& calibration = r.calibration)
    out += fmt::format("  calibration {} {} {}", calibration_name(*calibration),
                       base::printable(calibration->calibrator), remote_verdict(*calibration));
  for (const std::string_view alarm : r.alarm_names()) out += fmt::format("  ALARM {}", alarm);
  return out;
}

std::string words_of(const link::Host::Quality& quality, bool is_alive) {
  return fmt::format("link {}, loss {:.0f} % in, {:.0f} % out, round trip {} s", is_alive ? "alive" : "DEAD",
                     100 * quality.loss_in, 100 * quality.loss_out, shown_or_dash(quality.round_trip_s, 2));
}

std::string json_of(const link::Host::NewReport& report, const link::Host::Quality& quality, bool is_alive) {
  const link::Report& r = report.report;
  RemoteObject out{{"class", "REPORT"}};
  out["time"] = r.time_utc_ms ? RemoteObject(static_cast<double>(*r.time_utc_ms) * 1e-3) : RemoteObject(nullptr);
  out["north"] = r.is_north_true ? "true" : "magnetic";
  out["heading_deg"] = json_or_null(r.heading_deg);
  out["pitch_deg"] = json_or_null(r.pitch_deg);
  out["roll_deg"] = json_or_null(r.roll_deg);
  out["rate_deg_s"] = json_list(r.rate_deg_s);
  out["depth_m"] = json_or_null(r.depth_m);
  out["lat"] = json_or_null(r.latitude_deg);
  out["lon"] = json_or_null(r.longitude_deg);
  out["position_std_m"] = json_or_null(r.position_std_m);
  out["heading_std_deg"] = json_or_null(r.heading_std_deg);
  out["depth_std_m"] = json_or_null(r.depth_std_m);
  out["speed_m_s"] = json_or_null(r.speed_m_s);
  out["climb_m_s"] = json_or_null(r.climb_m_s);
  out["shaft_rpm"] = json_or_null(r.shaft_rpm);
  out["fins_deg"] = json_list(r.fins_deg);
  out["age_s"] = {{"compass", json_or_null(r.compass_age_s)},
                  {"imu", json_or_null(r.imu_age_s)},
                  {"gps", json_or_null(r.gps_age_s)},
                  {"motor", json_or_null(r.motor_age_s)}};
  out["alarms"] = r.alarm_names();
  out["battery_V"] = json_or_null(r.battery_V);
  out["battery_charge"] = json_or_null(r.battery_charge);
  out["motor"] = {{"holder", r.holder.empty() ? RemoteObject(nullptr) : RemoteObject(base::printable(r.holder))},
                  {"priority", r.priority},
                  {"expires_in_s", json_or_null(r.expires_in_s)},
                  {"order", r.order_sequence}};
  out["calibration"] = nullptr;
  if (const auto& calibration = r.calibration)
    out["calibration"] = {{"name", calibration_name(*calibration)},
                          {"calibrator", base::printable(calibration->calibrator)},
                          {"verdict", remote_verdict(*calibration)}};
  out["verified"] = report.is_verified;
  out["link"] = {{"alive", is_alive},
                 {"loss_in", quality.loss_in},
                 {"loss_out", quality.loss_out},
                 {"round_trip_s", json_or_null(quality.round_trip_s)}};
  return out.dump();
}

}  // namespace navcal::cli
