// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "base/durations.h"
#include "instruments/devices.h"
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
