// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "calib/magnetometer/field_segments.h"
#include "calib/magnetometer/magnetometer_estimate.h"

namespace navcal::calib {

/// Steps of the field, and the segments of time between them, told as a whole.
///
/// The size of a step is the difference of the hard iron of the two segments, fitted jointly with soft iron and
/// dip in common (fit_segments), so that a segment that saw little turning has the shape of its neighbour. A step
/// is withdrawn when the readings since show that there was none: its size is nothing, or one field explains the
/// size of all readings as well as two. Tilt that accelerations falsify can feign a step for a while.
class FieldHistory {
 public:
  static constexpr std::size_t kMost = 64;  ///< steps that are kept; older ones go

  FieldHistory();
  /// A reading that was used.
  void add(const FieldCells<3, 6>::Cell& reading, double time_s, std::int64_t utc_ns);
  /// The field stepped: what comes belongs to another segment.
  void begin_segment(const FieldStep& step);
  /// The vehicle is at another place: what comes is no evidence about the steps so far.
  void begin_place() { before_ = now_ = FieldHistory().now_; }
  /// Fits the last two segments anew. To be called at the end, before a new segment, and now and then. True: the
  /// last step is withdrawn, and its two segments are one. `is_sure`: the last step is none to be withdrawn.
  bool refine(const SegmentNoise& noise, const SegmentBelief& belief, bool is_sure = false);
  [[nodiscard]] bool is_time_to_refine() const { return !steps_.empty() && readings() >= next_refinement_; }

  [[nodiscard]] const std::vector<FieldStep>& steps() const { return steps_; }
  [[nodiscard]] const std::vector<FieldSegment>& segments() const { return segments_; }
  /// Change of the hard iron over the last `count` steps. A field that returned is exactly the one before.
  [[nodiscard]] IronShift shift_over(std::size_t count) const;
  void archive(Archive& archive);

 private:
  /// True when both segments turned and one field explains the size of their readings as well as `two`.
  [[nodiscard]] bool one_field_explains(const SegmentsFit& two, const SegmentNoise& noise,
                                        const SegmentBelief& belief) const;
  /// Records the spread of the field's size in each of the last two segments, when their shape is fitted to the
  /// size alone.
  void tell_spreads(const SegmentNoise& noise, const SegmentBelief& belief);
  /// There was no step between the last two segments.
  void withdraw();
  [[nodiscard]] std::uint64_t readings() const { return segments_.empty() ? 0 : segments_.back().readings; }

  std::vector<FieldStep> steps_;
  std::vector<FieldSegment> segments_;  ///< one more than steps once there is a reading
  FieldCells<3, 6> before_, now_;       ///< of the last two segments
  std::uint64_t next_refinement_ = kFirstRefinement;

  static constexpr std::uint64_t kFirstRefinement = 64;
};

}  // namespace navcal::calib
