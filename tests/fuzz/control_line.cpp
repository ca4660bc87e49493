// SPDX-License-Identifier: Apache-2.0
// Whatever comes in over the control socket is a request or is refused with one line of valid JSON. An order that
// is within the limits makes a whole line for the card.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "control/order.h"
#include "daemon/control_request.h"
#include "protocols/motor_card.h"

namespace {

/// An order within the limits makes a line that the card reads as it was meant.
void check_order(const navcal::daemon::ControlRequest& request) {
  namespace motor = navcal::protocols::motor_card;
  const navcal::config::CommandSettings settings;
  if (!navcal::control::beyond_limits(request.order, settings).empty()) return;
  const auto command = navcal::control::rounded_for_card(request.order);
  const auto read = motor::decode_command(motor::encode_command(command));
  if (!read || *read != command || std::abs(read->rpm) > settings.max_rpm) std::abort();
  for (const double fin_deg : read->fins_deg) {
    if (std::abs(fin_deg) > motor::kFinLimit_deg) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace navcal::daemon;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  const auto parsed = parse_control(line);
  if (const auto* error = std::get_if<std::string>(&parsed)) {
    const std::string answer = control_error(*error);
    if (answer.find('\n') != answer.size() - 1 || !nlohmann::json::accept(answer)) std::abort();
  } else {
    check_order(std::get<ControlRequest>(parsed));
  }
  // Bytes from the client must never break a line either.
  const std::string echoed = control_error(line);
  if (echoed.find('\n') != echoed.size() - 1 || !nlohmann::json::accept(echoed)) std::abort();
  return 0;
}
