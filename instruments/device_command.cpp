// SPDX-License-Identifier: Apache-2.0
#include "instruments/device_command.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/durations.h"
#include "base/line_reader.h"
#include "instruments/tcm2_dialogue.h"
#include "protocols/decimal.h"
#include "protocols/oncore.h"
#include "protocols/oncore_command.h"
#include "protocols/oncore_messages.h"
#include "protocols/tcm2.h"
#include "protocols/tcm2_commands.h"
#include "protocols/tcm2_reply.h"

namespace navcal::instruments {
namespace {

namespace oncore = protocols::oncore;
namespace tcm2 = protocols::tcm2;
using Outcome = DeviceCommand::Outcome;
using protocols::Protocol;
/// The outcome that a frame brings; nullopt when it is no answer.
using Judge = std::optional<Outcome> (*)(const protocols::Frame& frame);

struct Step {
  std::vector<std::uint8_t> bytes;
  std::int64_t wait_ns = 0;  ///< until the next step, or longest wait for the answer
};

/// The bytes to send, step by step. The last step asks and is repeated.
struct Conversation {
  std::vector<Step> steps;
  int attempts = 1;
  Judge judge = nullptr;
};

/// A restarted TCM2 sends its banner within a second; a slow one is given more.
constexpr std::int64_t kBanner_ns = 5 * base::kSecond_ns;
/// The receiver reads its input once a second and answers within the second after the next.
constexpr std::int64_t kReceiverAnswers_ns = 3 * base::kSecond_ns + base::kSecond_ns / 2;

std::string line_of(protocols::Bytes bytes) {
  std::string text(bytes.begin(), bytes.end());
  while (!text.empty() && (text.back() == '\r' || text.back() == '\n')) text.pop_back();
  return text;
}

std::optional<Outcome> refusal(const protocols::Frame& frame) {
  const auto reply = frame.id == tcm2::kReply ? tcm2::decode_reply(frame.bytes) : std::nullopt;
  if (!reply || reply->kind != tcm2::Reply::Kind::refused) return std::nullopt;
  std::string text = "refused (E";
  protocols::append_hex(text, reply->error, 3);
  return Outcome{false, text + ')'};
}

std::optional<Outcome> words_come(const protocols::Frame& frame) {
  if (frame.id == tcm2::kBanner) return Outcome{false, "the compass has restarted"};
  if (frame.id == tcm2::kReply) return refusal(frame);
  return Outcome{true, "words come"};
}

std::optional<Outcome> score(const protocols::Frame& frame) {
  const auto reply = frame.id == tcm2::kReply ? tcm2::decode_reply(frame.bytes) : std::nullopt;
  if (!reply || reply->kind != tcm2::Reply::Kind::calibration) return refusal(frame);
  const std::string text = line_of(frame.bytes);
  return Outcome{true, text.substr(text.find('H'))};
}

std::optional<Outcome> banner(const protocols::Frame& frame) {
  if (frame.id != tcm2::kBanner) return refusal(frame);
  return Outcome{true, line_of(frame.bytes)};
}

/// The lines of the identification without the blanks that fill them.
std::optional<Outcome> identification(const protocols::Frame& frame) {
  if (frame.id != oncore::kCj) return std::nullopt;
  const auto text = oncore::decode_cj(frame.bytes);
  if (!text) return std::nullopt;
  std::string joined;
  for (std::string_view rest = *text; !rest.empty();) {
    const std::string_view line = base::trimmed(base::take_until(rest, "\r\n"), " ");
    if (line.empty()) continue;
    joined += joined.empty() ? "" : "; ";
    joined += line;
  }
  return Outcome{true, std::move(joined)};
}

std::optional<Outcome> defaults_set(const protocols::Frame& frame) {
  if (frame.id != oncore::kCf) return std::nullopt;
  return Outcome{true, "almanac, time and position are forgotten; the first fix takes minutes"};
}

Conversation restart_stream(const config::PortSettings& settings) {
  return {{{bytes_of(tcm2::Verb::halt), kBetweenHalts_ns},
           {bytes_of(tcm2::Verb::halt), kSettle_ns},
           {bytes_of(tcm2::Verb::go), stopped_after_ns(settings.rate_Hz, kTcm2Stopped_ns)}},
          kAttempts,
          words_come};
}

Conversation calibration_score(const config::PortSettings& /*settings*/) {
  return {{{bytes_of(tcm2::Verb::calibration_score), kReplyTimeout_ns}}, kAttempts, score};
}

// A second restart would undo what the first one began.
Conversation restart(const config::PortSettings& /*settings*/) {
  return {{{bytes_of(tcm2::Verb::warm_restart), kBanner_ns}}, 1, banner};
}

Conversation receiver_id(const config::PortSettings& /*settings*/) {
  return {{{oncore::encode_poll(oncore::kCj, 0), kReceiverAnswers_ns}}, 2, identification};
}

Conversation cold_start(const config::PortSettings& /*settings*/) {
  return {{{oncore::encode_poll(oncore::kCf, 0), kReceiverAnswers_ns}}, 1, defaults_set};
}

struct Entry {
  DeviceCommandName name;
  Conversation (*conversation)(const config::PortSettings& settings) = nullptr;
};

constexpr Entry kTcm2Commands[] = {
    {{"restart_stream", "stops the words and lets them begin again (h, h, go)"}, restart_stream},
    {{"calibration_score", "asks for the score of the compass's calibration of itself (lc?)"}, calibration_score},
    {{"restart", "restarts the compass (ax); it sends nothing until it is set up again", true}, restart},
};
constexpr Entry kOncoreCommands[] = {
    {{"receiver_id", "asks for model, serial number and version (@@Cj)"}, receiver_id},
    {{"cold_start", "sets the receiver to its defaults (@@Cf); it loses almanac, time and position", true},
     cold_start},
};
/// A device that takes no commands has none here.
std::span<const Entry> commands_of(Protocol protocol) {
  if (protocol == Protocol::tcm2) return kTcm2Commands;
  if (protocol == Protocol::oncore) return kOncoreCommands;
  return {};
}

class ScriptedCommand final : public DeviceCommand {
 public:
  ScriptedCommand(Conversation conversation, std::int64_t now_ns) : conversation_(std::move(conversation)) {
    start_at(now_ns);
  }

 private:
  Script script() override {
    for (std::size_t i = 0; i + 1 < conversation_.steps.size(); ++i)
      co_await send(conversation_.steps[i].bytes, conversation_.steps[i].wait_ns);
    const Step& question = conversation_.steps.back();
    const bool answered = co_await ask(question.bytes, conversation_.attempts, question.wait_ns,
                                       [this](const protocols::Frame& frame) {
                                         outcome_ = conversation_.judge(frame);
                                         return outcome_.has_value();
                                       });
    if (!answered) outcome_ = Outcome{false, "no answer"};
  }

  Conversation conversation_;
};

}  // namespace

std::vector<DeviceCommandName> device_commands(Protocol protocol) {
  std::vector<DeviceCommandName> names;
  for (const Entry& entry : commands_of(protocol)) names.push_back(entry.name);
  return names;
}

std::unique_ptr<DeviceCommand> make_device_command(const config::PortSettings& settings, std::string_view name,
                                                   std::int64_t now_ns) {
  for (const Entry& entry : commands_of(settings.protocol)) {
    if (entry.name.name == name) return std::make_unique<ScriptedCommand>(entry.conversation(settings), now_ns);
  }
  return nullptr;
}

}  // namespace navcal::instruments
