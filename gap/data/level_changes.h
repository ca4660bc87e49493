// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace navcal::gap {

/// Model: a series of independent means about a level that changes at a few unknown places, and may change
/// back.
///
/// Method: circular binary segmentation (Olshen, Venkatraman, Lucito and Wigler, Biostatistics 5, 2004). In
/// each segment it finds the stretch whose mean differs most from the rest of the segment, by the t statistic
/// with the remaining scatter. Where that is significant, the segment is cut there and its parts are searched
/// again. A stretch that reaches an end of the segment is a permanent change, any other one a temporary change.
struct LevelChanges {
  std::size_t least_pieces = 6;   ///< of each part, where the level changes for good
  std::size_t least_stretch = 3;  ///< of one that goes away
  double clear = 8;               ///< t statistic of a change
  double least_difference = 0;    ///< of levels

  /// Indices at which a new level begins, in their order.
  [[nodiscard]] std::vector<std::size_t> of(const std::vector<double>& means) const;
};

}  // namespace navcal::gap
