// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>
#include <utility>

#include "base/durations.h"
#include "instruments/devices.h"
#include "protocols/decimal.h"
#include "protocols/keller.h"
#include "protocols/paroscientific.h"

namespace navcal::instruments {

namespace keller = protocols::keller;

/// Keller pressure transmitter (ICD section 15): answers to F73 as pressure. The transmitter must be one that
/// measures absolute pressure (PAA). Answers do not name their channel: only the pressure channel is ever asked
/// for.
Verdict read_keller(const protocols::Frame& frame, const config::PortSettings&, Receiver& receiver) {
  constexpr double kBar_Pa = 1e5;
  const auto reading = keller::decode_reading(frame.bytes);
  if (!reading) return Verdict::ignored;
  const double pressure_Pa = double{reading->value} * kBar_Pa;
  if (reading->failed(keller::kPressureChannel) || !std::isfinite(pressure_Pa)) return Verdict::out_of_range;
  DepthSample sample;
  sample.pressure_Pa = pressure_Pa;
  hand_over(sample, receiver);
  return Verdict::used;
}

namespace {

/// A transmitter answers within some milliseconds. Slow ones need 100 ms for the first answer after power-on.
constexpr std::int64_t kIdentityAnswer_ns = base::kSecond_ns / 2;
constexpr std::int64_t kPoll_ns = base::kSecond_ns / 10;
constexpr unsigned kSilentPolls = 10;

/// Keller transmitter (ICD section 15): initialises it (F48), then asks for the pressure ten times a second (F73).
/// A transmitter that says it is not initialised, or that is silent, is initialised anew.
class StartUpKeller final : public StartUp {
 private:
  Script script() override {
    for (;;) {
      enter("initialising (F48)");
      refuses_ = false;
      while (!co_await ask(keller::initialise_request(keller::kAnyAddress), 1, kIdentityAnswer_ns,
                           [](const protocols::Frame& frame) { return frame.id == keller::kInitialised; })) {
        if (!refuses_) enter("no answer to F48: trying again twice a second");
      }
      refuses_ = lost_ = false;
      enter(kRunning, true);
      for (unsigned silent_polls = 0; silent_polls < kSilentPolls && !lost_;) {
        ++silent_polls;
        co_await ask(keller::read_request(keller::kAnyAddress, keller::kPressureChannel), 1, to_the_next_poll_ns(),
                     [this, &silent_polls](const protocols::Frame& frame) {
                       if (frame.id == keller::kReading) {
                         silent_polls = 0;
                         if (std::exchange(refuses_, false)) enter(kRunning, true);
                       }
                       return lost_;
                     });
      }
    }
  }

  void on_any_frame(const protocols::Frame& frame) override {
    const auto refusal = keller::decode_refusal(frame.bytes);
    if (!refusal || frame.id != keller::kError) return;
    lost_ = refusal->error == keller::kNotInitialised;
    refuses_ = !lost_;
    if (refuses_) enter("the transmitter refuses, error " + std::to_string(refusal->error), in_service());
  }

  /// Polls keep their beat, unless the host was late by more than one.
  [[nodiscard]] std::int64_t to_the_next_poll_ns() const {
    const std::int64_t late_ns = now_ns() - deadline_ns();
    return late_ns > 0 && late_ns < kPoll_ns ? kPoll_ns - late_ns : kPoll_ns;
  }

  static constexpr const char* kRunning = "running, asked ten times a second";
  bool refuses_ = false;  ///< since the last answer
  bool lost_ = false;     ///< it is not initialised any more
};

}  // namespace

std::unique_ptr<StartUp> start_keller(const config::PortSettings&) { return std::make_unique<StartUpKeller>(); }

namespace {

namespace paroscientific = protocols::paroscientific;

constexpr int kPsi = 1;

/// Paroscientific Digiquartz gauge for absolute pressure (ICD section 14). A number does not name its unit: it
/// counts from the answer on that states it (UN), which the start-up dialogue asks for. Without the dialogue the
/// unit is the one of delivery, psi.
class ParoscientificGauge final : public Instrument {
 public:
  explicit ParoscientificGauge(const config::PortSettings& settings) {
    if (!settings.start_up) unit_Pa_ = paroscientific::unit_Pa(kPsi);
  }

  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    if (paroscientific::address_of(frame.bytes).to != paroscientific::kHost) return Verdict::ignored;
    if (frame.id == paroscientific::kUnits) {
      const auto code = protocols::integer<int>(paroscientific::parameter_of(frame.bytes));
      if (!code) return Verdict::out_of_range;
      unit_Pa_ = paroscientific::unit_Pa(*code);
      return Verdict::used;
    }
    if (frame.id != paroscientific::kValue || !unit_Pa_) return Verdict::ignored;
    const auto value = paroscientific::decode_value(frame.bytes);
    if (!value) return Verdict::ignored;
    DepthSample sample;
    sample.pressure_Pa = *value * *unit_Pa_;
    hand_over(sample, receiver);
    return Verdict::used;
  }

 private:
  std::optional<double> unit_Pa_;
};

}  // namespace

std::unique_ptr<Instrument> make_paroscientific(const config::PortSettings& settings) {
  return std::make_unique<ParoscientificGauge>(settings);
}

namespace {

/// A gauge that samples answers when the sample is over. As delivered that takes 0.7 s; it can be set to many
/// seconds.
constexpr std::int64_t kUnitAnswer_ns = 2 * base::kSecond_ns;
constexpr std::int64_t kFirstValue_ns = 10 * base::kSecond_ns;
constexpr std::int64_t kValuesStopped_ns = 10 * base::kSecond_ns;
constexpr int kUnitAttempts = 5;
constexpr int kValueAttempts = 3;

bool is_answer(const protocols::Frame& frame, protocols::FrameId id) {
  return frame.id == id && paroscientific::address_of(frame.bytes).to == paroscientific::kHost;
}

bool is_value(const protocols::Frame& frame) { return is_answer(frame, paroscientific::kValue); }

std::string running_text(const std::string& unit) {
  const auto code = protocols::integer<int>(unit);
  if (code && paroscientific::unit_Pa(*code)) return "running, UN=" + unit;
  return "values come in a unit that is not known (UN=" + unit + "): they are not used; set UN to 1 to 8";
}

/// Paroscientific gauge (ICD section 14): asks for the unit (UN), then for continuous sampling (P4). Both leave
/// its permanent settings alone. Begins again when the values stop, as after a loss of power.
class StartUpParoscientific final : public StartUp {
 private:
  Script script() override {
    const auto command = [](protocols::FrameId id) {
      return paroscientific::encode_line({paroscientific::kFirstGauge, paroscientific::kHost}, id.view());
    };
    std::string unit;
    const auto is_unit = [&unit](const protocols::Frame& frame) {
      if (!is_answer(frame, paroscientific::kUnits)) return false;
      unit = paroscientific::parameter_of(frame.bytes);
      return true;
    };
    for (;;) {
      enter("asked for the unit (UN)");
      if (co_await ask(command(paroscientific::kUnits), kUnitAttempts, kUnitAnswer_ns, is_unit)) {
        fruitless_ = 0;
        enter("asked for continuous values (P4)");
        // Values that came while the unit was asked for are of an earlier P4, which UN ends.
        bool come = co_await ask(command(paroscientific::kContinuous), kValueAttempts, kFirstValue_ns, is_value);
        if (come) enter(running_text(unit), true);
        while (come) come = co_await wait(kValuesStopped_ns, is_value);
        if (in_service()) continue;
      }
      ++fruitless_;
    }
  }
  [[nodiscard]] std::string remark() const override {
    if (fruitless_ == 0) return {};
    return ": no answer, trying again, " + std::to_string(fruitless_) + " times so far";
  }
};

}  // namespace

std::unique_ptr<StartUp> start_paroscientific(const config::PortSettings&) {
  return std::make_unique<StartUpParoscientific>();
}

}  // namespace navcal::instruments
