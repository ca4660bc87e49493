// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "base/durations.h"
#include "instruments/start_ups.h"
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
 public:
  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::polling; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,          ///< begin() has not been called
    initialising,  ///< F48 is to be sent, or its answer is awaited
    polling,       ///< F73 is sent at each due_ns_
  };

  Phase phase_ = Phase::idle;
  unsigned unanswered_ = 0;   ///< requests in a row
  std::uint8_t refused_ = 0;  ///< error of the last refusal since the last answer; 0: none
};

}  // namespace

void StartUpKeller::begin(std::int64_t now_ns) {
  phase_ = Phase::initialising;
  due_ns_ = now_ns;
  unanswered_ = 0;
  refused_ = 0;
}

void StartUpKeller::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (phase_ == Phase::idle) return;
  if (frame.id == keller::kInitialised && phase_ == Phase::initialising) {
    phase_ = Phase::polling;
    due_ns_ = now_ns;
    unanswered_ = 0;
    refused_ = 0;
  } else if (frame.id == keller::kReading && phase_ == Phase::polling) {
    unanswered_ = 0;
    refused_ = 0;
  } else if (const auto refusal = keller::decode_refusal(frame.bytes); refusal && frame.id == keller::kError) {
    refused_ = refusal->error;
    if (phase_ == Phase::polling && refusal->error == keller::kNotInitialised) {
      phase_ = Phase::initialising;
      due_ns_ = now_ns;
    }
  }
}

std::optional<std::vector<std::uint8_t>> StartUpKeller::next(std::int64_t now_ns) {
  if (now_ns < due_ns_) return std::nullopt;
  if (phase_ == Phase::polling && unanswered_ >= kSilentPolls) phase_ = Phase::initialising;
  ++unanswered_;
  if (phase_ == Phase::initialising) {
    due_ns_ = now_ns + kIdentityAnswer_ns;
    return keller::initialise_request(keller::kAnyAddress);
  }
  // Polls keep their beat, unless the host was late by more than one.
  due_ns_ = now_ns - due_ns_ < kPoll_ns ? due_ns_ + kPoll_ns : now_ns + kPoll_ns;
  return keller::read_request(keller::kAnyAddress, keller::kPressureChannel);
}

std::string StartUpKeller::state() const {
  if (phase_ == Phase::idle) return "not begun";
  if (refused_ != 0 && refused_ != keller::kNotInitialised)
    return "the transmitter refuses, error " + std::to_string(refused_);
  if (phase_ == Phase::polling) return "running, asked ten times a second";
  return unanswered_ < 2 ? "initialising (F48)" : "no answer to F48: trying again twice a second";
}

std::unique_ptr<StartUp> start_keller(const config::PortSettings&) { return std::make_unique<StartUpKeller>(); }

}  // namespace navcal::instruments
