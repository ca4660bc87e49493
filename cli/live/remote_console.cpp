// SPDX-License-Identifier: Apache-2.0
#include "cli/live/remote_console.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/printable.h"
#include "cli/live/watch_text.h"
#include "link/host.h"
#include "link/report.h"
#include "record/json/put_members.h"

namespace navcal::cli {
namespace {

using RemoteObject = nlohmann::ordered_json;

std::string shown_or_dash(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : std::string("-");
}

std::string calibration_name(const link::CalibrationState& state) {
  return state.number == 0 ? std::string("none") : fmt::format("{}-{:08x}", state.number, state.hash);
}

std::string remote_verdict(const link::CalibrationState& state) {
  return state.verdict < link::kVerdictNames.size() ? std::string(link::kVerdictNames.at(state.verdict))
                                                    : "unknown";
}

/// One line for people.
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

/// "alive, loss 3 % in, 0 % out, round trip 0.21 s"
std::string words_of(const link::Host::Quality& quality, bool is_alive) {
  return fmt::format("link {}, loss {:.0f} % in, {:.0f} % out, round trip {} s", is_alive ? "alive" : "DEAD",
                     100 * quality.loss_in, 100 * quality.loss_out, shown_or_dash(quality.round_trip_s, 2));
}

/// One object without a line end: {"class":"REPORT",...}; what is not known is null.
std::string json_of(const link::Host::NewReport& report, const link::Host::Quality& quality, bool is_alive) {
  const link::Report& r = report.report;
  RemoteObject out{{"class", "REPORT"}};
  out["time"] = r.time_utc_ms ? RemoteObject(static_cast<double>(*r.time_utc_ms) * 1e-3) : RemoteObject(nullptr);
  out["north"] = r.is_north_true ? "true" : "magnetic";
  NAVCAL_PUT_MEMBERS(out, r, heading_deg, pitch_deg, roll_deg, rate_deg_s, depth_m);
  out["lat"] = r.latitude_deg;
  out["lon"] = r.longitude_deg;
  NAVCAL_PUT_MEMBERS(out, r, position_std_m, heading_std_deg, depth_std_m, speed_m_s, climb_m_s, shaft_rpm,
                     fins_deg);
  out["age_s"] = {
      {"compass", r.compass_age_s}, {"imu", r.imu_age_s}, {"gps", r.gps_age_s}, {"motor", r.motor_age_s}};
  out["alarms"] = r.alarm_names();
  NAVCAL_PUT_MEMBERS(out, r, battery_V, battery_charge);
  out["motor"] = {{"holder", r.holder.empty() ? RemoteObject(nullptr) : RemoteObject(base::printable(r.holder))},
                  {"priority", r.priority},
                  {"expires_in_s", r.expires_in_s},
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
                 {"round_trip_s", quality.round_trip_s}};
  return out.dump();
}

constexpr std::string_view kRemoteHelp =
    "lease            take charge of the motor\n"
    "order RPM A B C  shaft speed and three fin angles in degrees, repeated until the next one\n"
    "stop             the safe state at once; ends every lease, whoever holds it\n"
    "release          gives the own lease back, with the same effect\n"
    "status           what navcald says of itself\n"
    "send {JSON}      any line of the control socket\n"
    "quit             stop, and end";

/// The first two rows are the picture, the others scroll.
constexpr const char* kBeginScreen = "\033[2J\033[3r\033[3;1H";
constexpr const char* kEndScreen = "\033[r\033[999;1H\n";

std::string first_word(std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string word;
  words >> word;
  return word;
}

}  // namespace

RemoteConsole::RemoteConsole(RemoteOperator& remote, Picture picture) : remote_(remote), picture_(picture) {
  if (picture_ == Picture::terminal) put(kBeginScreen);
  remote_.on_notice = [this](std::string_view words) { say(words); };
}

RemoteConsole::~RemoteConsole() {
  remote_.on_notice = [](std::string_view) {};
  if (picture_ == Picture::terminal) put(kEndScreen);
}

void RemoteConsole::put(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void RemoteConsole::say(std::string_view words) {
  put((picture_ == Picture::json ? nlohmann::json{{"class", "NOTICE"}, {"text", words}}.dump()
                                 : std::string(words)) +
      "\n");
}

bool RemoteConsole::give_order(std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string name;
  double shaft_rpm = 0;
  std::array<double, 3> fins_deg{};
  words >> name >> shaft_rpm >> fins_deg[0] >> fins_deg[1] >> fins_deg[2];
  std::string rest;
  if (!words || words >> rest) {
    say("order needs four numbers: shaft speed in rpm and three fin angles in degrees");
    return false;
  }
  if (remote_.order(shaft_rpm, fins_deg)) return true;
  say("nobody is in charge: type lease, and wait for its ok");
  return false;
}

bool RemoteConsole::take(std::string_view line) {
  const std::string word = first_word(line);
  if (word.empty()) return true;
  if (word == "quit") return false;
  if (word == "lease") {
    remote_.lease();
  } else if (word == "order") {
    (void)give_order(line);
  } else if (word == "stop") {
    remote_.stop();
  } else if (word == "release") {
    remote_.release();
  } else if (word == "status") {
    if (!remote_.host().request(R"({"command":"status"})")) say("there is no session yet");
  } else if (word == "send") {
    const auto begin = line.find('{');
    if (begin == std::string_view::npos || !remote_.host().request(line.substr(begin)))
      say("send needs an object of JSON and a session");
  } else {
    say(kRemoteHelp);
  }
  return true;
}

void RemoteConsole::show_report(const link::Host::NewReport& report) {
  const auto quality = remote_.host().quality();
  const bool is_alive = remote_.is_alive();
  if (picture_ == Picture::json) {
    put(json_of(report, quality, is_alive) + "\n");
  } else {
    const std::string state = words_of(report.report);
    const std::string link =
        words_of(quality, is_alive) + (report.is_verified ? "" : "; reports are not authenticated");
    if (picture_ == Picture::terminal) {
      put(fmt::format("\0337\033[1;1H\033[?7l\033[2K{}\033[2;1H\033[2K{}\033[?7h\0338", state, link));
    } else {
      if (RemoteOperator::Clock::now() < next_line_) return;
      next_line_ = RemoteOperator::Clock::now() + std::chrono::milliseconds(900);
      put(state + "; " + link + "\n");
    }
  }
}

void RemoteConsole::show() {
  if (const auto report = remote_.host().take_report()) show_report(*report);
  if (const auto answer = remote_.take_answer()) {
    if (picture_ == Picture::json) {
      const bool is_ok = *answer == "ok";
      nlohmann::ordered_json out{{"class", "ANSWER"}, {"ok", is_ok}};
      if (!is_ok) out["error"] = base::printable(*answer);
      put(out.dump() + "\n");
    } else {
      say(base::printable(*answer));
    }
  }
  while (auto response = remote_.host().take_response()) {
    while (response->ends_with('\n')) response->pop_back();
    if (picture_ == Picture::json) {
      auto parsed = nlohmann::ordered_json::parse(*response, nullptr, false);
      if (parsed.is_discarded()) parsed = base::printable(*response);
      put(nlohmann::ordered_json{{"class", "RESPONSE"}, {"response", std::move(parsed)}}.dump() + "\n");
    } else {
      say(base::printable(*response));
    }
  }
}

}  // namespace navcal::cli
