// SPDX-License-Identifier: Apache-2.0
#include "cli/control_link.h"

#include <nlohmann/json.hpp>

#include "analysis/failure.h"
#include "base/interruptible.h"

namespace navcal::cli {
namespace {

/// A disk that has to be woken takes some seconds.
constexpr std::chrono::seconds kControlAnswerLimit{30};

[[noreturn]] void fail_control(const std::string& why) { throw analysis::Failure(analysis::Exit::failed, why); }

}  // namespace

nlohmann::json ControlLink::ask(const nlohmann::json& request) {
  socket_.send(request.dump() + "\n");
  const auto until = LineSocket::Clock::now() + kControlAnswerLimit;
  const auto line = socket_.next(until);
  if (!line) fail_control(base::Interruptible::interrupted() ? "interrupted" : "navcald does not answer");
  auto answer = nlohmann::json::parse(*line, nullptr, false);
  if (!answer.is_object()) fail_control("that is no navcald: its answer is no JSON object");
  if (answer.value("ok", false)) return answer;
  fail_control("navcald: " + answer.value("error", std::string("refused")));
}

}  // namespace navcal::cli
