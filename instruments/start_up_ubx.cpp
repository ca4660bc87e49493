// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/start_ups.h"
#include "protocols/ubx_configuration.h"
#include "protocols/ubx_receiver.h"

namespace navcal::instruments {
namespace {

namespace ubx = protocols::ubx;
using ubx::ReceiverPort;

/// A receiver answers a configuration within a second, by its interface description; the rest is for a slow wire.
constexpr std::int64_t kUbxAnswer_ns = base::kSecond_ns + base::kSecond_ns / 4;
constexpr std::int64_t kUbxStopped_ns = 3 * base::kSecond_ns;
constexpr std::int64_t kUbxRest_ns = 10 * base::kSecond_ns;
constexpr int kUbxAttempts = 3;
constexpr double kLeastInterval_ms = 25, kLongestInterval_ms = 60'000;
constexpr double kSky_s = 5;  // between two lists of satellites, which are the longest message
constexpr std::uint8_t kMostEpochs = 255;

struct WantedMessage {
  ubx::MessageCode code;
  std::uint8_t epochs;
};

/// NAV-PVT first: a receiver that refuses it is of no use.
std::array<WantedMessage, 4> wanted_messages(double rate_Hz) {
  const double once_a_second = std::max(1.0, std::round(rate_Hz));
  const auto epochs = [](double wanted) {
    return static_cast<std::uint8_t>(std::min<double>(wanted, kMostEpochs));
  };
  return {{{ubx::kNavPvt, 1},
           {ubx::kNavDop, 1},
           {ubx::kNavTimeGps, epochs(once_a_second)},
           {ubx::kNavSat, epochs(kSky_s * once_a_second)}}};
}

std::uint16_t interval_ms(double rate_Hz) {
  return static_cast<std::uint16_t>(
      std::clamp(std::round(1000 / rate_Hz), kLeastInterval_ms, kLongestInterval_ms));
}

std::string_view name_of(ReceiverPort port) {
  switch (port) {
    case ReceiverPort::uart1: return "UART1";
    case ReceiverPort::uart2: return "UART2";
    case ReceiverPort::usb: break;
  }
  return "USB";
}

/// Receivers at a USB socket of their own are a modem to the system; all others are behind UART1, as a rule.
std::array<ReceiverPort, 3> ports_for(const config::PortSettings& settings) {
  const bool is_usb =
      settings.path.find("ttyACM") != std::string::npos || settings.udev_name.find("u-blox") != std::string::npos;
  if (is_usb) return {ReceiverPort::usb, ReceiverPort::uart1, ReceiverPort::uart2};
  return {ReceiverPort::uart1, ReceiverPort::usb, ReceiverPort::uart2};
}

std::vector<std::uint8_t> values_for(ReceiverPort port, double rate_Hz) {
  std::vector<ubx::ConfigurationItem> items;
  if (rate_Hz > 0) {
    items.push_back({ubx::kRateMeasurement_ms, interval_ms(rate_Hz)});
    items.push_back({ubx::kRateNavigation, 1});
  }
  for (const auto& [code, epochs] : wanted_messages(rate_Hz))
    items.push_back({ubx::key_of_message(code, port), epochs});
  items.push_back({ubx::key_of_ubx_output(port), 1});
  items.push_back({ubx::key_of_nmea_output(port), 0});
  return ubx::encode_cfg_valset(ubx::Layer::ram, items);
}

/// u-blox receiver (ICD section 6): asks for its version, then sets rate, messages and protocols in its RAM with
/// CFG-VALSET. The receiver does not tell at which of its ports we are: they are tried one after the other until
/// NAV-PVT comes. A receiver that refuses CFG-VALSET is set with CFG-MSG and CFG-RATE, which concern the port that
/// carries them. Begins again when NAV-PVT stops, as after a restart of the receiver.
class StartUpUbx final : public StartUp {
 public:
  explicit StartUpUbx(const config::PortSettings& settings);

  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  using MessageCode = protocols::ubx::MessageCode;
  using ReceiverPort = protocols::ubx::ReceiverPort;

  enum class Phase : std::uint8_t {
    idle,      ///< begin() has not been called
    version,   ///< MON-VER is to be asked for
    setting,   ///< CFG-VALSET for ports_[port_] is to be sent or waits for its answer
    legacy,    ///< legacy_[step_] is to be sent or waits for its answer
    awaiting,  ///< all is sent, NAV-PVT is waited for
    resting,   ///< it did not come; all is repeated at due_ns_
    running,
  };
  /// A message of class CFG that is answered by ACK-ACK or ACK-NAK.
  struct Step {
    MessageCode code = 0;
    std::string what;  ///< for people
    std::vector<std::uint8_t> bytes;
    bool needed = false;  ///< without it the rest is of no use
  };

  void start_over(std::int64_t now_ns);
  void enter(Phase phase, std::int64_t now_ns);
  void on_answer(bool accepted, std::int64_t now_ns);
  void go_on(std::int64_t now_ns);
  void next_port(std::int64_t now_ns);
  /// Nothing helped: all is repeated after a while.
  void rest(std::int64_t now_ns);
  [[nodiscard]] const Step* current() const;
  std::optional<std::vector<std::uint8_t>> send(std::int64_t now_ns);

  std::vector<Step> values_;  ///< one for each port of the receiver, the likely one first
  std::vector<Step> legacy_;
  std::int64_t stopped_after_ns_;  ///< NAV-PVT is taken to have stopped after this time without one
  Phase phase_ = Phase::idle;
  std::size_t step_ = 0;
  int attempts_ = 0;                            ///< times that the current step was sent
  bool by_values_ = false;                      ///< a CFG-VALSET was accepted in this dialogue
  bool nmea_seen_ = false;                      ///< in this dialogue
  unsigned fruitless_ = 0;                      ///< dialogues in a row after which no NAV-PVT came
  std::string version_, refused_, unanswered_;  ///< for people
};

}  // namespace

StartUpUbx::StartUpUbx(const config::PortSettings& settings) : stopped_after_ns_(kUbxStopped_ns) {
  for (const ReceiverPort port : ports_for(settings)) {
    values_.push_back({ubx::kCfgValset, "CFG-VALSET for " + std::string(name_of(port)),
                       values_for(port, settings.rate_Hz), false});
  }
  const auto set_rate = [this](ubx::MessageCode code, std::string name, std::uint8_t epochs, bool needed) {
    legacy_.push_back(
        {ubx::kCfgMsg, "CFG-MSG for " + std::move(name), ubx::encode_cfg_msg({code, epochs}), needed});
  };
  for (const auto& [code, epochs] : wanted_messages(settings.rate_Hz)) {
    set_rate(code, std::string(ubx::name_of(code)), epochs, code == ubx::kNavPvt);
  }
  if (settings.rate_Hz > 0) {
    stopped_after_ns_ = std::max(kUbxStopped_ns, static_cast<std::int64_t>(3e9 / settings.rate_Hz));
    legacy_.push_back(
        {ubx::kCfgRate, "CFG-RATE", ubx::encode_cfg_rate({interval_ms(settings.rate_Hz), 1}), false});
  }
  // The sentences that are sent as delivered, F0 00 to F0 05, and last: without NAV-PVT they are used.
  constexpr std::array<std::string_view, 6> kSentences{"GGA", "GLL", "GSA", "GSV", "RMC", "VTG"};
  for (std::size_t i = 0; i < kSentences.size(); ++i) {
    set_rate(static_cast<ubx::MessageCode>(0xF000 + i), std::string(kSentences[i]), 0, false);
  }
}

void StartUpUbx::begin(std::int64_t now_ns) {
  fruitless_ = 0;
  version_.clear();
  start_over(now_ns);
}

void StartUpUbx::start_over(std::int64_t now_ns) {
  by_values_ = nmea_seen_ = false;
  refused_.clear();
  unanswered_.clear();
  enter(Phase::version, now_ns);
}

void StartUpUbx::enter(Phase phase, std::int64_t now_ns) {
  phase_ = phase;
  step_ = 0;
  attempts_ = 0;
  due_ns_ = now_ns;
}

const StartUpUbx::Step* StartUpUbx::current() const {
  if (phase_ == Phase::setting && step_ < values_.size()) return &values_[step_];
  if (phase_ == Phase::legacy && step_ < legacy_.size()) return &legacy_[step_];
  return nullptr;
}

void StartUpUbx::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (phase_ == Phase::idle) return;
  const auto code = ubx::code_of(frame);
  if (!code) {
    nmea_seen_ = nmea_seen_ || ubx::kind_of(frame) == ubx::Kind::nmea;
    return;
  }
  if (*code == ubx::kNavPvt) {
    // While the settings are under way, it is that of an earlier configuration.
    if (phase_ != Phase::awaiting && phase_ != Phase::running && phase_ != Phase::resting) return;
    phase_ = Phase::running;
    due_ns_ = now_ns + stopped_after_ns_;
    fruitless_ = 0;
  } else if (*code == ubx::kMonVer) {
    const auto version = ubx::decode_mon_ver(frame.bytes);
    if (!version) return;
    version_ = version->software;
    for (const std::string& extension : version->extensions) {
      if (extension.starts_with("MOD=") || extension.starts_with("FWVER=") || extension.starts_with("PROTVER"))
        version_ += ", " + extension;
    }
  } else if (const auto answer = ubx::decode_acknowledgement(frame.bytes)) {
    const Step* const step = current();
    if (step != nullptr && attempts_ > 0 && answer->code == step->code) on_answer(answer->accepted, now_ns);
  }
}

void StartUpUbx::on_answer(bool accepted, std::int64_t now_ns) {
  const Step& step = *current();
  if (!accepted) refused_ += (refused_.empty() ? "" : ", ") + step.what;
  if (phase_ == Phase::setting) {
    if (accepted) {
      by_values_ = true;
      phase_ = Phase::awaiting;
      due_ns_ = now_ns + stopped_after_ns_;
    } else if (by_values_) {
      next_port(now_ns);  // it has no such port
    } else {
      enter(Phase::legacy, now_ns);
    }
    return;
  }
  if (!accepted && step.needed) {
    phase_ = Phase::awaiting;
    due_ns_ = now_ns;
    return;
  }
  go_on(now_ns);
}

/// To the next step of the older configuration.
void StartUpUbx::go_on(std::int64_t now_ns) {
  ++step_;
  attempts_ = 0;
  due_ns_ = now_ns;
  if (step_ < legacy_.size()) return;
  phase_ = Phase::awaiting;
  due_ns_ = now_ns + stopped_after_ns_;
}

void StartUpUbx::next_port(std::int64_t now_ns) {
  phase_ = Phase::setting;
  ++step_;
  attempts_ = 0;
  due_ns_ = now_ns;
  if (step_ < values_.size()) return;
  rest(now_ns);
}

void StartUpUbx::rest(std::int64_t now_ns) {
  ++fruitless_;
  phase_ = Phase::resting;
  due_ns_ = now_ns + kUbxRest_ns;
}

std::optional<std::vector<std::uint8_t>> StartUpUbx::next(std::int64_t now_ns) {
  if (now_ns < due_ns_) return std::nullopt;
  switch (phase_) {
    case Phase::idle: return std::nullopt;
    case Phase::version: enter(Phase::setting, now_ns); return ubx::encode_frame(ubx::kMonVer, {});
    case Phase::setting:
    case Phase::legacy: return send(now_ns);
    case Phase::awaiting:
      if (by_values_) {
        next_port(now_ns);
        return phase_ == Phase::setting ? send(now_ns) : std::nullopt;
      }
      rest(now_ns);
      return std::nullopt;
    case Phase::resting:
    case Phase::running: start_over(now_ns); return next(now_ns);
  }
  return std::nullopt;
}

std::optional<std::vector<std::uint8_t>> StartUpUbx::send(std::int64_t now_ns) {
  // After one step was repeated in vain, the following ones are not repeated.
  const int allowed = unanswered_.empty() ? kUbxAttempts : 1;
  if (attempts_ >= allowed) {
    unanswered_ += (unanswered_.empty() ? "" : ", ") + current()->what;
    if (phase_ == Phase::legacy && current()->needed) {
      phase_ = Phase::awaiting;
      due_ns_ = now_ns + stopped_after_ns_;
    } else if (phase_ == Phase::legacy) {
      go_on(now_ns);
    } else if (by_values_) {
      next_port(now_ns);
    } else {
      enter(Phase::legacy, now_ns);
    }
    if (current() == nullptr) return std::nullopt;
  }
  ++attempts_;
  due_ns_ = now_ns + kUbxAnswer_ns;
  return current()->bytes;
}

std::string StartUpUbx::state() const {
  std::string text;
  switch (phase_) {
    case Phase::idle: return "not begun";
    case Phase::version: text = "asking for the version"; break;
    case Phase::setting:
    case Phase::legacy: text = "setting: " + (current() != nullptr ? current()->what : std::string("done")); break;
    case Phase::awaiting: text = "settings sent, waiting for NAV-PVT"; break;
    case Phase::resting:
      text = std::string(nmea_seen_ ? "running on NMEA: no NAV-PVT comes" : "no NAV-PVT comes") +
             "; trying again every 10 s, " + std::to_string(fruitless_) + " so far";
      break;
    case Phase::running: text = "running on NAV-PVT"; break;
  }
  if (!version_.empty()) text += "; " + version_;
  if (!refused_.empty()) text += "; refused: " + refused_;
  if (!unanswered_.empty()) text += "; no answer to: " + unanswered_;
  return text;
}

std::unique_ptr<StartUp> start_ubx(const config::PortSettings& settings) {
  return std::make_unique<StartUpUbx>(settings);
}

}  // namespace navcal::instruments
