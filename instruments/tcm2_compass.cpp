// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "base/durations.h"
#include "instruments/compass_error.h"
#include "instruments/devices.h"
#include "instruments/tcm2_dialogue.h"
#include "instruments/units.h"
#include "protocols/tcm2.h"
#include "protocols/tcm2_commands.h"

namespace navcal::instruments {

namespace tcm2 = protocols::tcm2;

/// PNI TCM2: data words, and its heading as NMEA. What an error code voids is absent from the sample: heading and
/// tilt with the inclinometer out of range (E002), heading and field with the magnetometer (E004), nothing with
/// distortion near (E001).
Verdict read_tcm2(const protocols::Frame& frame, const config::PortSettings& settings, Receiver& receiver) {
  CompassSample sample;
  if (frame.id == tcm2::kWord) {
    const auto word = tcm2::decode_word(frame.bytes);
    if (!word) return Verdict::out_of_range;
    const CompassError error(word->error);
    if (!error.tilt_out_of_range) {
      if (word->heading && !error.field_out_of_range)
        sample.heading_rad = radians_of(*word->heading, settings.compass.heading_unit);
      if (word->pitch) sample.pitch_rad = radians_of(*word->pitch, settings.compass.tilt_unit);
      if (word->roll) sample.roll_rad = radians_of(*word->roll, settings.compass.tilt_unit);
    }
    if (!error.field_out_of_range) sample.field_body_uT = word->field();
    if (word->temperature)
      sample.temperature_C = celsius_of(*word->temperature, settings.compass.temperature_unit);
    sample.error = word->error;
  } else if (frame.id == tcm2::kHchdm) {
    const auto heading_deg = tcm2::decode_hchdm(frame.bytes);
    if (!heading_deg) return Verdict::out_of_range;
    sample.heading_rad = *heading_deg * base::kRadiansPerDegree;
  } else {
    return Verdict::ignored;
  }
  hand_over(sample, receiver);
  return Verdict::used;
}

namespace {

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

/// TCM2 (ICD section 1): `h` twice, the settings one after the other, `go`. Begins again when the device announces
/// itself (banner) or its words stop.
class StartUpTcm2 final : public StartUp {
 public:
  explicit StartUpTcm2(const config::PortSettings& settings)
      : settings_(settings_for(settings)), stopped_ns_(stopped_after_ns(settings.rate_Hz, kTcm2Stopped_ns)) {}

 private:
  Script script() override {
    for (;;) {
      enter("halting the device");
      refused_.clear();
      unanswered_.clear();
      co_await send(bytes_of(Verb::halt), kBetweenHalts_ns);
      co_await send(bytes_of(Verb::halt), kSettle_ns);
      for (std::size_t i = 0; i < settings_.size(); ++i) {
        const tcm2::Command& setting = settings_[i];
        enter(fmt::format("setting {} ({} of {})", text_of(setting), i + 1, settings_.size()));
        // After one setting was repeated in vain, the following ones are not repeated. A device whose replies do
        // not come through is then in service soon all the same.
        if (!co_await ask(tcm2::encode_command(setting), unanswered_.empty() ? kAttempts : 1, kReplyTimeout_ns,
                          [this, &setting](const protocols::Frame& frame) { return is_reply(frame, setting); }))
          note(unanswered_, text_of(setting));
      }
      enter("settings sent, waiting for words");
      const std::int64_t patience_ns =
          std::max(stopped_ns_, std::min(stopped_ns_ << std::min(fruitless_, 4U), kMostPatience_ns));
      if (!co_await ask(bytes_of(Verb::go), 1, patience_ns, is_word)) {
        ++fruitless_;
        continue;
      }
      enter("running", true);
      fruitless_ = 0;
      while (co_await wait(stopped_ns_, is_word)) continue;
    }
  }
  void on_any_frame(const protocols::Frame& frame) override {
    if (frame.id == tcm2::kBanner) start_at(now_ns() + kSettle_ns);
  }
  [[nodiscard]] std::string remark() const override {
    return fruitless_ == 0 ? "" : fmt::format("; no words came so far, attempt {}", fruitless_ + 1);
  }

  static bool is_word(const protocols::Frame& frame) {
    return frame.id != tcm2::kReply && frame.id != tcm2::kBanner;
  }

  bool is_reply(const protocols::Frame& frame, const tcm2::Command& setting) {
    if (frame.id != tcm2::kReply) return false;
    const auto reply = tcm2::decode_reply(frame.bytes);
    if (!reply || reply->kind == tcm2::Reply::Kind::calibration) return false;
    if (reply->kind == tcm2::Reply::Kind::value) return reply->parameter == tcm2::name_of(setting.parameter);
    if (reply->kind == tcm2::Reply::Kind::refused)
      note(refused_, fmt::format("{} (E{:03X})", text_of(setting), reply->error));
    return true;
  }

  std::vector<protocols::tcm2::Command> settings_;
  std::int64_t stopped_ns_;  ///< words are taken to have stopped after this time without one
};

}  // namespace

std::unique_ptr<StartUp> start_tcm2(const config::PortSettings& settings) {
  return std::make_unique<StartUpTcm2>(settings);
}

}  // namespace navcal::instruments
