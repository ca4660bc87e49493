// SPDX-License-Identifier: Apache-2.0
// Whatever comes in over the control socket is a request or is refused with one line of valid JSON. An order that
// is within the limits makes a whole line for the card.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "control/order.h"
#include "daemon/control_request.h"
#include "daemon/log_answers.h"
#include "protocols/motor_card.h"
#include "record/log/log_shelf.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::control_line_target {

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

/// The numbers of a download are within their bounds, and the name of a log leads nowhere else. The folder has no
/// logs, so that nothing may ever be read.
void check_download(const navcal::daemon::ControlRequest& request) {
  using navcal::daemon::ControlCommand;
  namespace record = navcal::record;
  const bool is_sum = request.command == ControlCommand::log_sum;
  if (request.command != ControlCommand::log_read && !is_sum) return;
  const std::uint64_t most_bytes = is_sum ? record::kMaxSum_bytes : record::kMaxPart_bytes;
  if (request.length == 0 || request.length > most_bytes || request.offset > INT64_MAX) std::abort();
  if (record::is_log_name(request.file) &&
      request.file.find_first_not_of("-.0123456789TZacelmnpv") != std::string::npos)
    std::abort();
  const std::string answer = navcal::daemon::answer_from_disk("/", request);
  if (answer.find("\"ok\":false") == std::string::npos || !nlohmann::json::accept(answer)) std::abort();
}

NAVCAL_FUZZ(control_line) {
  using namespace navcal::daemon;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  const auto parsed = parse_control(line);
  if (const auto* error = std::get_if<std::string>(&parsed)) {
    const std::string answer = control_error(*error);
    if (answer.find('\n') != answer.size() - 1 || !nlohmann::json::accept(answer)) std::abort();
  } else {
    check_order(std::get<ControlRequest>(parsed));
    check_download(std::get<ControlRequest>(parsed));
  }
  // Bytes from the client must never break a line either.
  const std::string echoed = control_error(line);
  if (echoed.find('\n') != echoed.size() - 1 || !nlohmann::json::accept(echoed)) std::abort();
  return 0;
}

}  // namespace navcal::fuzz::control_line_target
