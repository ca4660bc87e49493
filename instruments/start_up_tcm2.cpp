// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/durations.h"
#include "instruments/start_ups.h"
#include "instruments/tcm2_dialogue.h"
#include "protocols/decimal.h"
#include "protocols/tcm2.h"
#include "protocols/tcm2_commands.h"

namespace navcal::instruments {
namespace {

namespace tcm2 = protocols::tcm2;
using tcm2::Parameter;
using tcm2::Verb;

constexpr std::int64_t kMostPatience_ns = 10 * base::kSecond_ns;

/// `clock=` and `sp=` that come nearest to a rate. Among equally near pairs, one with sp = rate wins, because
/// it means the same to a TCM2 (clock divided by sp) and to a TCM2.5 (sp in Hz). Then the smallest divider
/// wins.
std::pair<int, int> clock_and_period(double rate_Hz) {
  constexpr int kSlowest = 5, kFastest = 40, kMostPeriod = 40;
  std::pair<int, int> best{kSlowest, 1};
  double best_miss = std::numeric_limits<double>::infinity();
  for (int period = 1; period <= kMostPeriod; ++period) {
    for (int clock = kSlowest; clock <= kFastest; ++clock) {
      const double miss = std::abs(static_cast<double>(clock) / period - rate_Hz);
      const bool same_to_both = miss == best_miss && static_cast<double>(period) == rate_Hz;
      if (miss < best_miss || same_to_both) {
        best_miss = miss;
        best = {clock, period};
      }
    }
  }
  return best;
}

std::vector<tcm2::Command> settings_for(const config::PortSettings& port) {
  using config::AngleUnit;
  std::vector<tcm2::Command> commands;
  const auto set = [&commands](Parameter parameter, auto value) {
    commands.push_back(tcm2::set(parameter, value));
  };
  const auto set_unit = [&set](Parameter parameter, AngleUnit unit) {
    if (unit == AngleUnit::counts16) return;  // no unit of this device: leave it as it is
    set(parameter, unit == AngleUnit::mils ? 'm' : 'd');
  };
  set_unit(Parameter::heading_unit, port.compass.heading_unit);
  set_unit(Parameter::tilt_unit, port.compass.tilt_unit);
  set(Parameter::temperature_unit, port.compass.temperature_unit == config::TemperatureUnit::F ? 'f' : 'c');
  for (const auto field : {Parameter::output_heading, Parameter::output_pitch, Parameter::output_roll,
                           Parameter::output_field, Parameter::output_temperature}) {
    set(field, 'e');
  }
  set(Parameter::output_format, 't');
  if (port.rate_Hz > 0) {
    const auto [clock, period] = clock_and_period(port.rate_Hz);
    set(Parameter::clock, clock);
    set(Parameter::sample_period, period);
  }
  return commands;
}

std::string text_of(const tcm2::Command& command) {
  const auto bytes = tcm2::encode_command(command);
  return {bytes.begin(), bytes.end() - 1};  // without its CR
}

void add_to_list(std::string& list, const std::string& item) {
  if (!list.empty()) list += ", ";
  list += item;
}

/// TCM2 (ICD section 1): `h` twice, the settings one after the other, `go`. Begins again when the device announces
/// itself (banner) or its words stop.
class StartUpTcm2 final : public StartUp {
 public:
  explicit StartUpTcm2(const config::PortSettings& settings);

  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,           ///< begin() has not been called
    first_halt,     ///< the first `h` is due
    second_halt,    ///< the second `h` is due
    setting,        ///< settings_[current_] is to be sent or waits for its reply
    awaiting_word,  ///< `go` was sent
    running,
  };

  void halt_at(std::int64_t when_ns);
  void on_reply(const protocols::Frame& frame, std::int64_t now_ns);
  std::optional<std::vector<std::uint8_t>> next_setting(std::int64_t now_ns);
  [[nodiscard]] int attempts_allowed() const;
  void go_on_to_next(std::int64_t now_ns);

  std::vector<protocols::tcm2::Command> settings_;
  std::int64_t stopped_after_ns_;  ///< words are taken to have stopped after this time without one
  std::int64_t patience_ns_;       ///< how long the first word after `go` is waited for
  Phase phase_ = Phase::idle;
  std::size_t current_ = 0;
  int attempts_ = 0;        ///< times that the current setting was sent
  unsigned fruitless_ = 0;  ///< dialogues in a row after which no word came
  std::string unanswered_;  ///< settings without a reply in this dialogue, for people
  std::string refused_;     ///< settings refused in it, likewise
};

}  // namespace

StartUpTcm2::StartUpTcm2(const config::PortSettings& settings)
    : settings_(settings_for(settings)), stopped_after_ns_(kTcm2Stopped_ns) {
  if (settings.rate_Hz > 0) {
    stopped_after_ns_ = std::max(kTcm2Stopped_ns, static_cast<std::int64_t>(3e9 / settings.rate_Hz));
  }
  patience_ns_ = stopped_after_ns_;
}

void StartUpTcm2::begin(std::int64_t now_ns) {
  patience_ns_ = stopped_after_ns_;
  fruitless_ = 0;
  halt_at(now_ns);
}

void StartUpTcm2::halt_at(std::int64_t when_ns) {
  phase_ = Phase::first_halt;
  due_ns_ = when_ns;
  current_ = 0;
  attempts_ = 0;
  unanswered_.clear();
  refused_.clear();
}

void StartUpTcm2::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (phase_ == Phase::idle) return;
  if (frame.id == tcm2::kBanner) {
    halt_at(now_ns + kSettle_ns);
  } else if (frame.id == tcm2::kReply) {
    on_reply(frame, now_ns);
  } else if (phase_ == Phase::awaiting_word || phase_ == Phase::running) {
    phase_ = Phase::running;
    due_ns_ = now_ns + stopped_after_ns_;
    patience_ns_ = stopped_after_ns_;
    fruitless_ = 0;
  }
}

void StartUpTcm2::on_reply(const protocols::Frame& frame, std::int64_t now_ns) {
  if (phase_ != Phase::setting || attempts_ == 0) return;  // to one of the halts
  const auto reply = tcm2::decode_reply(frame.bytes);
  if (!reply) return;
  const tcm2::Command& command = settings_[current_];
  switch (reply->kind) {
    case tcm2::Reply::Kind::calibration: return;
    case tcm2::Reply::Kind::value:
      if (reply->parameter != tcm2::name_of(command.parameter)) return;
      break;
    case tcm2::Reply::Kind::refused: {
      std::string item = text_of(command) + " (E";
      protocols::append_hex(item, reply->error, 3);
      add_to_list(refused_, item + ')');
      break;
    }
    case tcm2::Reply::Kind::accepted: break;
  }
  go_on_to_next(now_ns);
}

void StartUpTcm2::go_on_to_next(std::int64_t now_ns) {
  ++current_;
  attempts_ = 0;
  due_ns_ = now_ns;
}

/// After one setting was repeated in vain, the following ones are not repeated. A device whose replies do not
/// come through is then in service soon all the same.
int StartUpTcm2::attempts_allowed() const { return unanswered_.empty() ? kAttempts : 1; }

std::optional<std::vector<std::uint8_t>> StartUpTcm2::next(std::int64_t now_ns) {
  if (now_ns < due_ns_) return std::nullopt;
  switch (phase_) {
    case Phase::idle: return std::nullopt;
    case Phase::awaiting_word:
      ++fruitless_;
      patience_ns_ = std::max(stopped_after_ns_, std::min(2 * patience_ns_, kMostPatience_ns));
      halt_at(now_ns);
      break;
    case Phase::running: halt_at(now_ns); break;
    case Phase::first_halt:
    case Phase::second_halt: break;
    case Phase::setting: return next_setting(now_ns);
  }
  const bool first = phase_ == Phase::first_halt;
  phase_ = first ? Phase::second_halt : Phase::setting;
  due_ns_ = now_ns + (first ? kBetweenHalts_ns : kSettle_ns);
  return tcm2::encode_command({Verb::halt});
}

std::optional<std::vector<std::uint8_t>> StartUpTcm2::next_setting(std::int64_t now_ns) {
  if (current_ < settings_.size() && attempts_ >= attempts_allowed()) {
    add_to_list(unanswered_, text_of(settings_[current_]));
    go_on_to_next(now_ns);
  }
  if (current_ == settings_.size()) {
    phase_ = Phase::awaiting_word;
    due_ns_ = now_ns + patience_ns_;
    return tcm2::encode_command({Verb::go});
  }
  ++attempts_;
  due_ns_ = now_ns + kReplyTimeout_ns;
  return tcm2::encode_command(settings_[current_]);
}

std::string StartUpTcm2::state() const {
  std::string text;
  switch (phase_) {
    case Phase::idle: return "not begun";
    case Phase::first_halt:
    case Phase::second_halt: text = "halting the device"; break;
    case Phase::setting:
      text = current_ == settings_.size()
                 ? "settings sent"
                 : "setting " + text_of(settings_[current_]) + " (" + std::to_string(current_ + 1) + " of " +
                       std::to_string(settings_.size()) + ")";
      break;
    case Phase::awaiting_word: text = "settings sent, waiting for words"; break;
    case Phase::running: text = "running"; break;
  }
  if (fruitless_ > 0) text += "; no words came so far, attempt " + std::to_string(fruitless_ + 1);
  if (!refused_.empty()) text += "; refused: " + refused_;
  if (!unanswered_.empty()) text += "; no reply to: " + unanswered_;
  return text;
}

std::unique_ptr<StartUp> start_tcm2(const config::PortSettings& settings) {
  return std::make_unique<StartUpTcm2>(settings);
}

}  // namespace navcal::instruments
