// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/devices.h"
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
constexpr const char* kSent = "settings sent, waiting for NAV-PVT";

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

 private:
  using MessageCode = protocols::ubx::MessageCode;

  /// A message of class CFG that is answered by ACK-ACK or ACK-NAK.
  struct Step {
    MessageCode code = 0;
    std::string what;  ///< for people
    std::vector<std::uint8_t> bytes;
    bool needed = false;  ///< without it the rest is of no use
  };

  Script script() override;
  void on_any_frame(const protocols::Frame& frame) override;
  /// To be followed by a look at accepted_.
  Wait set(const Step& step);
  Wait wait_for_solution(std::int64_t patience_ns) {
    return wait(patience_ns, [](const protocols::Frame& frame) { return ubx::code_of(frame) == ubx::kNavPvt; });
  }
  [[nodiscard]] std::string remark() const override { return version_.empty() ? "" : "; " + version_; }

  std::vector<Step> values_;  ///< one for each port of the receiver, the likely one first
  std::vector<Step> legacy_;
  std::int64_t stopped_ns_;  ///< NAV-PVT is taken to have stopped after this time without one
  bool accepted_ = false;    ///< the setting sent last
  bool nmea_seen_ = false;   ///< in this dialogue
  std::string version_;      ///< for people
};

}  // namespace

StartUpUbx::StartUpUbx(const config::PortSettings& settings)
    : stopped_ns_(stopped_after_ns(settings.rate_Hz, kUbxStopped_ns)) {
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
    legacy_.push_back(
        {ubx::kCfgRate, "CFG-RATE", ubx::encode_cfg_rate({interval_ms(settings.rate_Hz), 1}), false});
  }
  // The sentences that are sent as delivered, F0 00 to F0 05, and last: without NAV-PVT they are used.
  constexpr std::array<std::string_view, 6> kSentences{"GGA", "GLL", "GSA", "GSV", "RMC", "VTG"};
  for (std::size_t i = 0; i < kSentences.size(); ++i) {
    set_rate(static_cast<ubx::MessageCode>(0xF000 + i), std::string(kSentences[i]), 0, false);
  }
}

StartUp::Script StartUpUbx::script() {
  version_.clear();
  for (;;) {
    nmea_seen_ = false;
    refused_.clear();
    unanswered_.clear();
    enter("asking for the version");
    co_await send(ubx::encode_frame(ubx::kMonVer, {}), 0);
    bool by_values = false;  // a CFG-VALSET was accepted
    bool came = false;
    for (const Step& step : values_) {
      if (!co_await set(step)) {
        note(unanswered_, step.what);
      } else if (accepted_) {
        by_values = true;
        enter(kSent);
        came = co_await wait_for_solution(stopped_ns_);
        if (came) break;
      }
      if (!by_values) break;  // else the receiver has no such port, or it is not ours
    }
    if (!by_values) {
      bool in_vain = false;
      for (const Step& step : legacy_) {
        const bool answered = co_await set(step);
        if (!answered) note(unanswered_, step.what);
        in_vain = answered && !accepted_ && step.needed;
        if (step.needed && !(answered && accepted_)) break;
      }
      enter(kSent);
      if (!in_vain) came = co_await wait_for_solution(stopped_ns_);
    }
    if (!came) {
      ++fruitless_;
      enter(fmt::format("{}; trying again every 10 s, {} so far",
                        nmea_seen_ ? "running on NMEA: no NAV-PVT comes" : "no NAV-PVT comes", fruitless_));
      if (!co_await wait_for_solution(kUbxRest_ns)) continue;
    }
    enter("running on NAV-PVT", true);
    fruitless_ = 0;
    while (co_await wait_for_solution(stopped_ns_)) continue;
  }
}

StartUp::Wait StartUpUbx::set(const Step& step) {
  enter("setting: " + step.what);
  // After one step was repeated in vain, the following ones are not repeated.
  return ask(step.bytes, unanswered_.empty() ? kUbxAttempts : 1, kUbxAnswer_ns,
             [this, &step](const protocols::Frame& frame) {
               const auto answer = ubx::code_of(frame) ? ubx::decode_acknowledgement(frame.bytes) : std::nullopt;
               if (!answer || answer->code != step.code) return false;
               accepted_ = answer->accepted;
               if (!accepted_) note(refused_, step.what);
               return true;
             });
}

void StartUpUbx::on_any_frame(const protocols::Frame& frame) {
  const auto code = ubx::code_of(frame);
  if (!code) nmea_seen_ = nmea_seen_ || ubx::kind_of(frame) == ubx::Kind::nmea;
  if (code != ubx::kMonVer) return;
  const auto version = ubx::decode_mon_ver(frame.bytes);
  if (!version) return;
  version_ = version->software;
  for (const std::string& extension : version->extensions) {
    if (extension.starts_with("MOD=") || extension.starts_with("FWVER=") || extension.starts_with("PROTVER"))
      version_ += ", " + extension;
  }
}

std::unique_ptr<StartUp> start_ubx(const config::PortSettings& settings) {
  return std::make_unique<StartUpUbx>(settings);
}

}  // namespace navcal::instruments
