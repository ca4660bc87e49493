// SPDX-License-Identifier: Apache-2.0
#include "cli/emulate_console.h"

#include <fmt/format.h>

#include <sstream>

namespace navcal::cli {
namespace {

std::string set_probability(analysis::EmulateSession& session, std::istringstream& words,
                            void (analysis::Misbehaviour::*setter)(double)) {
  double probability = 0;
  if (!(words >> probability) || probability < 0 || probability > 1) return "a probability from 0 to 1 is missing";
  std::string name;
  if (words >> name) {
    analysis::EmulatedPort* port = session.find(name);
    if (port == nullptr) return fmt::format("there is no port {}", name);
    (port->misbehaviour().*setter)(probability);
    return {};
  }
  for (const auto& port : session.ports()) (port->misbehaviour().*setter)(probability);
  return {};
}

std::string act_on_port(analysis::EmulateSession& session, const std::string& verb, std::istringstream& words) {
  std::string name;
  words >> name;
  analysis::EmulatedPort* port = session.find(name);
  if (port == nullptr) return fmt::format("there is no port {}", name.empty() ? "named" : name);
  if (verb == "unplug") {
    port->unplug();
  } else if (verb == "replug") {
    port->replug();
  } else if (verb == "power-cycle") {
    port->power_cycle();
  } else {
    double seconds = 0;
    if (!(words >> seconds) || seconds <= 0) return "the number of seconds is missing";
    port->stall(seconds);
  }
  return {};
}

}  // namespace

std::string obey_line(analysis::EmulateSession& session, std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string verb;
  if (!(words >> verb)) return {};
  if (verb == "unplug" || verb == "replug" || verb == "power-cycle" || verb == "stall") {
    return act_on_port(session, verb, words);
  }
  if (verb == "noise") return set_probability(session, words, &analysis::Misbehaviour::set_noise);
  if (verb == "drop") return set_probability(session, words, &analysis::Misbehaviour::set_drop);
  if (verb == "imu-status") {
    unsigned bits = 0;
    if (!(words >> bits) || bits > 15)
      return "bits from 0 to 15: 1 leak forward, 2 leak aft, 4 over range, 8 low supply";
    const bool is_set = session.set_imu_status(static_cast<std::uint8_t>(bits));
    return is_set ? "" : "no inertial card is emulated";
  }
  if (verb == "quit") {
    session.stop();
    return {};
  }
  return fmt::format("'{}' is none of: {}", verb, kConsoleHelp);
}

}  // namespace navcal::cli
