// SPDX-License-Identifier: Apache-2.0
#include "daemon/state_report.h"

#include <fmt/format.h>

#include <iterator>

#include "base/angles.h"
#include "daemon/json_text.h"
#include "record/json/json_object.h"

namespace navcal::daemon {
namespace {

/// `name` as it begins: ,"depth_m": or {"compass":
void append_member(std::string& out, std::string_view name, const std::optional<double>& value, int decimals,
                   double unit = 1) {
  out += name;
  value ? append_shortest(out, *value * unit, decimals) : void(out += "null");
}

void append_vector(std::string& out, std::string_view name, const std::array<std::optional<double>, 3>& values,
                   int decimals) {
  append_member(out, name, values[0], decimals);
  append_member(out, ",", values[1], decimals);
  append_member(out, ",", values[2], decimals);
  out += ']';
}

void append_alarm_words(std::string& out, const std::vector<std::string_view>& alarms) {
  out += ",\"alarms\":[";
  bool first = true;
  for (const std::string_view alarm : alarms) {
    if (!first) out += ',';
    first = false;
    std::string words(alarm);
    for (char& c : words) c = c == '_' ? ' ' : c;
    append_quoted(out, words);
  }
  out += ']';
}

void append_motor(std::string& out, const VehicleState& state) {
  if (state.holder.empty()) {
    out += R"(,"motor":{"holder":null,"priority":null,"expires_in_s":null})";
  } else {
    out += ",\"motor\":{\"holder\":";
    append_quoted(out, state.holder);
    fmt::format_to(std::back_inserter(out), FMT_STRING(",\"priority\":{}"), state.priority);
    append_member(out, ",\"expires_in_s\":", state.expires_in_s, 3);
    out += '}';
  }
  if (state.order_sequence == 0) {
    out += R"(,"order":{"sequence":null,"late_s":null})";
  } else {
    fmt::format_to(std::back_inserter(out), FMT_STRING(",\"order\":{{\"sequence\":{}"), state.order_sequence);
    append_member(out, ",\"late_s\":", state.order_late_s, 6);
    out += '}';
  }
}

}  // namespace

void append_state(std::string& out, const VehicleState& state) {
  out += "{\"class\":\"STATE\",\"time\":";
  state.time_utc_ns ? record::append_seconds(out, *state.time_utc_ns) : void(out += "null");
  append_member(out, ",\"time_std\":", state.time_std_s, 6);
  out += state.is_north_true ? R"(,"north":"true")" : R"(,"north":"magnetic")";
  append_member(out, ",\"heading_rad\":", state.heading_rad, 6);
  append_member(out, ",\"pitch_rad\":", state.pitch_rad, 6);
  append_member(out, ",\"roll_rad\":", state.roll_rad, 6);
  if (const auto& rate = state.rate_rad_s) {
    append_vector(out, ",\"rate_rad_s\":[", {(*rate)[0], (*rate)[1], (*rate)[2]}, 6);
  } else {
    out += ",\"rate_rad_s\":null";
  }
  append_member(out, ",\"depth_m\":", state.depth_m, 4);
  append_member(out, ",\"lat\":", state.latitude_rad, 9, base::kDegreesPerRadian);
  append_member(out, ",\"lon\":", state.longitude_rad, 9, base::kDegreesPerRadian);
  append_member(out, ",\"position_std_m\":", state.position_std_m, 3);
  append_member(out, ",\"speed_m_s\":", state.speed_m_s, 4);
  append_member(out, ",\"climb_m_s\":", state.climb_m_s, 4);
  append_member(out, ",\"shaft_rpm\":", state.shaft_rpm, 1);
  append_vector(out, ",\"fins_deg\":[", state.fins_deg, 2);
  append_member(out, ",\"std\":{\"heading_rad\":", state.heading_std_rad, 6);
  append_member(out, ",\"pitch_rad\":", state.pitch_std_rad, 6);
  append_member(out, ",\"depth_m\":", state.depth_std_m, 4);
  append_member(out, ",\"speed_m_s\":", state.speed_std_m_s, 4);
  append_member(out, "},\"age_s\":{\"compass\":", state.compass_age_s, 6);
  append_member(out, ",\"imu\":", state.imu_age_s, 6);
  append_member(out, ",\"gps\":", state.gps_age_s, 6);
  append_member(out, ",\"motor\":", state.motor_age_s, 6);
  out += '}';
  append_alarm_words(out, state.alarms);
  append_motor(out, state);
  append_member(out, ",\"altitude_m\":", state.altitude_m, 3);
  append_member(out, ",\"altitude_std_m\":", state.altitude_std_m, 3);
  append_member(out, ",\"battery\":{\"voltage_V\":", state.battery_V, 3);
  append_member(out, ",\"charge_Ah\":", state.charge_Ah, 4);
  append_member(out, ",\"charge_std_Ah\":", state.charge_std_Ah, 4);
  out += "}}\r\n";
}

}  // namespace navcal::daemon
