// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "base/durations.h"
#include "instruments/start_ups.h"
#include "protocols/decimal.h"
#include "protocols/paroscientific.h"

namespace navcal::instruments {
namespace {

namespace paroscientific = protocols::paroscientific;

/// A gauge that samples answers when the sample is over. As delivered that takes 0.7 s; it can be set to many
/// seconds.
constexpr std::int64_t kUnitAnswer_ns = 2 * base::kSecond_ns;
constexpr std::int64_t kFirstValue_ns = 10 * base::kSecond_ns;
constexpr std::int64_t kValuesStopped_ns = 10 * base::kSecond_ns;
constexpr int kUnitAttempts = 5;
constexpr int kValueAttempts = 3;

/// Paroscientific gauge (ICD section 14): asks for the unit (UN), then for continuous sampling (P4). Both leave
/// its permanent settings alone. Begins again when the values stop, as after a loss of power.
class StartUpParoscientific final : public StartUp {
 public:
  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,           ///< begin() has not been called
    asking_unit,    ///< UN is to be sent, or its answer is awaited
    asking_values,  ///< P4 is to be sent, or the first value is awaited
    running,
  };

  void go_to(Phase phase, std::int64_t due_ns);
  std::optional<std::vector<std::uint8_t>> ask(std::int64_t now_ns);

  Phase phase_ = Phase::idle;
  int attempts_ = 0;        ///< times that the current command was sent
  unsigned fruitless_ = 0;  ///< commands in a row that were given up
  std::string unit_;        ///< as the gauge states it
};

}  // namespace

void StartUpParoscientific::begin(std::int64_t now_ns) {
  fruitless_ = 0;
  go_to(Phase::asking_unit, now_ns);
}

void StartUpParoscientific::go_to(Phase phase, std::int64_t due_ns) {
  phase_ = phase;
  due_ns_ = due_ns;
  attempts_ = 0;
}

void StartUpParoscientific::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (phase_ == Phase::idle || paroscientific::address_of(frame.bytes).to != paroscientific::kHost) return;
  if (frame.id == paroscientific::kUnits && phase_ == Phase::asking_unit) {
    unit_ = paroscientific::parameter_of(frame.bytes);
    fruitless_ = 0;
    go_to(Phase::asking_values, now_ns);
  } else if (frame.id == paroscientific::kValue) {
    // Values that still come while the unit is asked for are of an earlier P4, which UN ends.
    if (phase_ != Phase::asking_values && phase_ != Phase::running) return;
    fruitless_ = 0;
    go_to(Phase::running, now_ns + kValuesStopped_ns);
  }
}

std::optional<std::vector<std::uint8_t>> StartUpParoscientific::next(std::int64_t now_ns) {
  if (now_ns < due_ns_) return std::nullopt;
  if (phase_ == Phase::running) go_to(Phase::asking_unit, now_ns);
  return ask(now_ns);
}

std::optional<std::vector<std::uint8_t>> StartUpParoscientific::ask(std::int64_t now_ns) {
  const bool of_unit = phase_ == Phase::asking_unit;
  if (attempts_ == (of_unit ? kUnitAttempts : kValueAttempts)) {
    ++fruitless_;
    go_to(Phase::asking_unit, now_ns);
    return ask(now_ns);
  }
  ++attempts_;
  due_ns_ = now_ns + (of_unit ? kUnitAnswer_ns : kFirstValue_ns);
  const auto& command = of_unit ? paroscientific::kUnits : paroscientific::kContinuous;
  return paroscientific::encode_line({paroscientific::kFirstGauge, paroscientific::kHost}, command.view());
}

std::string StartUpParoscientific::state() const {
  const std::string given_up =
      fruitless_ == 0 ? "" : ": no answer, trying again, " + std::to_string(fruitless_) + " times so far";
  switch (phase_) {
    case Phase::idle: return "not begun";
    case Phase::asking_unit: return "asked for the unit (UN)" + given_up;
    case Phase::asking_values: return "asked for continuous values (P4)" + given_up;
    case Phase::running: break;
  }
  const auto code = protocols::integer<int>(unit_);
  if (!code || !paroscientific::unit_Pa(*code)) {
    return "values come in a unit that is not known (UN=" + unit_ + "): they are not used; set UN to 1 to 8";
  }
  return "running, UN=" + unit_;
}

std::unique_ptr<StartUp> start_paroscientific(const config::PortSettings&) {
  return std::make_unique<StartUpParoscientific>();
}

}  // namespace navcal::instruments
