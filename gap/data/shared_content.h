// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <unordered_set>

#include "gap/data/mission.h"

namespace navcal::gap {

/// Finds a stretch of one recording in another by the instruments' readings, whatever the times and the file.
class SharedContent {
 public:
  static constexpr std::size_t kRun = 20;

  explicit SharedContent(const Mission& mission);

  /// Seconds of the mission that was given here which `other` holds as well; 0 when they share nothing.
  [[nodiscard]] double shared_s(const SharedContent& other) const;

 private:
  /// Runs of one instrument.
  struct Runs {
    std::unordered_set<std::uint64_t> hashes;
    double seconds_each = 0;  ///< of the recording, for each run
  };
  [[nodiscard]] static double shared_s(const Runs& a, const Runs& b);

  Runs card_, compass_;
};

}  // namespace navcal::gap
