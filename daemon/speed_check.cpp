// SPDX-License-Identifier: Apache-2.0
#include "daemon/speed_check.h"

#include <fmt/format.h>

#include <array>

namespace navcal::daemon {
namespace {

/// Fewer bytes than these could be half a frame of the longest kind (Oncore's Cj has 294).
constexpr std::uint64_t kEnough_bytes = 400;
constexpr double kImplausibleShare = 0.1;
constexpr double kNoiseShare = 0.2;

/// Bytes that occur in no word of the ASCII protocols: what a UART at another speed makes much of, and what the
/// binary ones are full of at any speed.
constexpr std::array<bool, 256> kNotText = [] {
  std::array<bool, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = i >= 0x7f || (i < 0x20 && i != '\r' && i != '\n' && i != '\t');
  }
  return table;
}();

}  // namespace

void SpeedCheck::bytes(protocols::Bytes bytes) {
  bytes_ += bytes.size();
  for (const auto byte : bytes) implausible_ += kNotText[byte] ? 1 : 0;
}

SpeedCheck::Verdict SpeedCheck::judge(const protocols::Counters& counters) {
  const std::uint64_t frames = counters.frames - base_.frames;
  if (bytes_ < kEnough_bytes) {
    // Good news needs no further evidence.
    if (frames > 0 && (verdict_ == Verdict::wrong_speed || verdict_ == Verdict::no_frames))
      verdict_ = Verdict::good;
    return verdict_;
  }
  judged_bytes_ = bytes_;
  judged_bad_ = counters.bad_checksum - base_.bad_checksum;
  judged_skipped_ = counters.skipped_bytes - base_.skipped_bytes;
  if (frames > 0) {
    const bool noisy = static_cast<double>(judged_skipped_) > kNoiseShare * static_cast<double>(bytes_);
    verdict_ = noisy ? Verdict::noise : Verdict::good;
  } else {
    const bool text = static_cast<double>(implausible_) <= kImplausibleShare * static_cast<double>(bytes_);
    verdict_ = text ? Verdict::no_frames : Verdict::wrong_speed;
  }
  const Verdict verdict = verdict_;
  bytes_ = implausible_ = 0;
  base_ = counters;
  return verdict;
}

std::string SpeedCheck::message() const {
  switch (verdict_) {
    case Verdict::good: break;
    case Verdict::wrong_speed:
      return fmt::format("{} bytes, no intact frame: wrong speed? (configured {})", judged_bytes_, baud_);
    case Verdict::no_frames:
      if (protocol_ == protocols::Protocol::nmea && judged_bad_ > 0)
        return fmt::format(
            "{} sentences, none with a checksum that holds: let the device send checksums, or set "
            "require_checksum = false for this port if it has none",
            judged_bad_);
      return fmt::format("{} bytes, no intact frame, but plain text: another device or mode than {}?",
                         judged_bytes_, protocols::name_of(protocol_));
    case Verdict::noise:
      return fmt::format("noise: {} of {} bytes belong to no frame", judged_skipped_, judged_bytes_);
  }
  return {};
}

void SpeedCheck::restart(const protocols::Counters& counters) {
  bytes_ = implausible_ = 0;
  base_ = counters;
  verdict_ = Verdict::good;
}

}  // namespace navcal::daemon
