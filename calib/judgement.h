#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace navcal::calib {

/// Headings visited, in sectors of ten degrees clockwise from north: what a compass rose shows.
using Rose = std::array<std::uint32_t, 36>;

/// What a calibrator thinks of its own estimate.
struct Judgement {
  bool accepted = false;  ///< the data support the estimate; it may come into force
  std::string reason;     ///< empty when accepted; else what stands against it, for people
  std::string
      manoeuvre;         ///< what to do about it, for people: "turn through 140 more degrees, headings 200 to 340"
  double coverage = 0;   ///< 0..1, share of what the calibrator needs to see
  double condition = 0;  ///< condition number of the (scaled) information matrix; infinity: singular
  std::uint64_t samples = 0;
  // Root-mean-square on readings that had no part in the estimate, without and with it; 0 when there were none.
  double held_out_before = 0;
  double held_out_after = 0;
};

}  // namespace navcal::calib
