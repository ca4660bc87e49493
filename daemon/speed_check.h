// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "protocols/frame.h"

namespace navcal::daemon {

/// Tells a wrong line speed from noise. A UART at the wrong speed reads every byte wrong, so no frame is ever
/// intact and what comes is not what the protocol is made of; noise spoils some frames and leaves the others.
class SpeedCheck {
 public:
  enum class Verdict {
    good,         ///< or too little has come to say
    wrong_speed,  ///< no intact frame, and the bytes look like those of another speed
    no_frames,    ///< no intact frame, but clean text, which a wrong speed does not make: another device or mode
    noise,        ///< intact frames, and much between them that is none
  };

  SpeedCheck(protocols::Protocol protocol, int baud) : protocol_(protocol), baud_(baud) {}

  void bytes(protocols::Bytes bytes);
  /// Judges what came since the last verdict; `counters` are those of the port's parser. Keeps collecting while it
  /// is too little.
  Verdict judge(const protocols::Counters& counters);
  /// The last verdict in words; empty when it is good.
  [[nodiscard]] std::string message() const;
  /// The port was opened anew: nothing said so far counts.
  void restart(const protocols::Counters& counters);

 private:
  protocols::Protocol protocol_;
  int baud_;
  std::uint64_t implausible_ = 0;  ///< bytes that the protocol does not use
  std::uint64_t bytes_ = 0;
  protocols::Counters base_;
  Verdict verdict_ = Verdict::good;
  std::uint64_t judged_bytes_ = 0;
  std::uint64_t judged_bad_ = 0;
  std::uint64_t judged_skipped_ = 0;
};

}  // namespace navcal::daemon
