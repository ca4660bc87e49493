// SPDX-License-Identifier: Apache-2.0
#include "cli/live/pilot_link.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/angles.h"
#include "record/json/json_members.h"

namespace navcal::cli {
namespace {

using record::member_of, record::number_in;

std::optional<double> angle(const nlohmann::json& object, const char* key) {
  const auto degrees = number_in(object, key);
  return degrees ? std::optional(*degrees * base::kRadiansPerDegree) : std::nullopt;
}

constexpr std::string_view kStateRequest =
    "?WATCH={\"enable\":true,\"json\":true,\"classes\":[\"STATE\"],\"rate_Hz\":{\"STATE\":10}};\n";
/// Share of a lease's time-out for which an answer is awaited: an answer that comes later is no use, because the
/// lease ends by itself before long.
constexpr double kAwaited = 0.8;

}  // namespace

std::optional<StateLine> parse_state(std::string_view line) {
  const nlohmann::json report = nlohmann::json::parse(line, nullptr, false);
  if (!report.is_object() || member_of(report, "class") != "STATE") return std::nullopt;
  const auto time_s = number_in(report, "time");
  if (!time_s) return std::nullopt;
  StateLine state;
  state.time_s = *time_s;
  state.magnetic = member_of(report, "north") == "magnetic";
  autopilot::Reading& reading = state.reading;
  reading.heading_rad = number_in(report, "heading_rad");
  reading.pitch_rad = number_in(report, "pitch_rad");
  reading.roll_rad = number_in(report, "roll_rad");
  if (const auto rate = record::vector_in(report, "rate_rad_s"))
    reading.rate_rad_s = Eigen::Vector3d(rate->data());
  reading.depth_m = number_in(report, "depth_m");
  reading.altitude_m = number_in(report, "altitude_m");
  reading.latitude_rad = angle(report, "lat");
  reading.longitude_rad = angle(report, "lon");
  reading.speed_m_s = number_in(report, "speed_m_s");
  const nlohmann::json& age = member_of(report, "age_s");
  reading.compass_age_s = number_in(age, "compass");
  reading.imu_age_s = number_in(age, "imu");
  reading.motor_age_s = number_in(age, "motor");
  for (const nlohmann::json& alarm : member_of(report, "alarms")) {
    if (alarm.is_string()) reading.alarms.push_back(alarm.get<std::string>());
  }
  return state;
}

PilotLink::PilotLink(const Address& address)
    : status_(LineSocket::tcp(address.host, std::to_string(address.port))),
      control_(LineSocket::unix_domain(address.control)) {
  status_.send(kStateRequest);
}

std::optional<StateLine> PilotLink::state(Clock::time_point until) {
  std::optional<StateLine> newest;
  for (;;) {
    // Lines that wait are skipped in favour of the newest.
    const auto line = status_.next(newest ? Clock::now() : until);
    if (!line) return newest;
    if (auto state = parse_state(*line)) newest = std::move(state);
  }
}

PilotLink::Answer PilotLink::ask(const std::string& request) {
  control_.send(request + "\n");
  const auto until = Clock::now() + answer_limit_;
  std::optional<std::string> line;
  // A signal ends a wait early; the answer still belongs to this request.
  do line = control_.next(until);
  while (!line && Clock::now() < until);
  if (!line) throw std::runtime_error("navcald does not answer on its control socket");
  const nlohmann::json answer = nlohmann::json::parse(*line, nullptr, false);
  if (!answer.is_object()) throw std::runtime_error("no answer of a navcald: " + *line);
  if (answer.value("ok", false)) return {std::nullopt, answer.value("lease", "")};
  return {answer.value("error", "refused without a reason"), {}};
}

void PilotLink::lease(const Lease& wanted) {
  const nlohmann::json request{{"command", "motor.lease"},
                               {"holder", "pilot"},
                               {"priority", wanted.priority},
                               {"timeout_s", wanted.timeout_s}};
  const Answer answer = ask(request.dump());
  if (answer.refusal) throw std::runtime_error("no lease of the motor card: " + *answer.refusal);
  lease_ = answer.lease;
  const auto awaited = std::chrono::milliseconds(std::lround(1000 * kAwaited * wanted.timeout_s));
  answer_limit_ = std::max(answer_limit_, awaited);
}

std::optional<std::string> PilotLink::order(const autopilot::Orders& orders, double state_time_s) {
  nlohmann::json fins = nlohmann::json::array();
  for (const double fin_rad : orders.fins_rad) {
    // Tenths of a degree, the resolution of the card; never -0.
    fins.push_back(std::round(10 * fin_rad * base::kDegreesPerRadian) / 10 + 0.0);
  }
  const nlohmann::json request{{"command", "motor.order"},
                               {"lease", lease_},
                               {"shaft_rpm", std::lround(60 * orders.shaft_rps)},
                               {"fins_deg", fins},
                               {"state_time", state_time_s}};
  return ask(request.dump()).refusal;
}

void PilotLink::release() noexcept {
  if (lease_.empty()) return;
  try {
    (void)ask(nlohmann::json{{"command", "motor.release"}, {"lease", lease_}}.dump());
  } catch (const std::exception&) {
    // The lease ends by itself, and the daemon then stops the vehicle.
  }
  lease_.clear();
}

}  // namespace navcal::cli
