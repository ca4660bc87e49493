// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "base/durations.h"
#include "instruments/devices.h"
#include "protocols/keller.h"

namespace navcal::instruments {
namespace {

namespace keller = protocols::keller;

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

}  // namespace navcal::instruments
