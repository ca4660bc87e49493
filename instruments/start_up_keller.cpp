// SPDX-License-Identifier: Apache-2.0
#include "instruments/start_up_keller.h"

#include "base/durations.h"
#include "protocols/keller.h"

namespace navcal::instruments {
namespace {

namespace keller = protocols::keller;

/// A transmitter answers within some milliseconds. Slow ones need 100 ms for the first answer after power-on.
constexpr std::int64_t kIdentityAnswer_ns = base::kSecond_ns / 2;
constexpr std::int64_t kPoll_ns = base::kSecond_ns / 10;
constexpr unsigned kSilentPolls = 10;

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

}  // namespace navcal::instruments
