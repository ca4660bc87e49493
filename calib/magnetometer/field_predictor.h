// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "calib/magnetometer/field_segments.h"

namespace navcal::calib {

/// A reading of the field as the predictor sees it: a cell of one, and how far off its tilt may be.
struct PredictedReading {
  FieldCells<3, 6>::Cell cell;
  double tilt_error_rad = 0;
};
/// Roll or pitch not a number: the tilt is not known.
[[nodiscard]] FieldCells<3, 6>::Cell cell_of(const Eigen::Vector3d& field_body_uT, double roll_rad,
                                             double pitch_rad);

/// Foretells a reading of the field from those before it: size and, where the tilt is known, dip.
///
/// The squared departure is in units of its predicted variance (normalised innovation squared, Bar-Shalom, Li and
/// Kirubarajan, Estimation with Applications to Tracking and Navigation, 2001, 5.4): noise of the reading, what no
/// model describes, and the uncertainty of the fit carried to the reading's attitude, J P J'. An attitude that
/// nothing was seen of has a prediction of large variance, so that its first readings are information and no
/// surprise.
class FieldPredictor {
 public:
  explicit FieldPredictor(double noise_uT, const std::optional<KnownField>& known);

  /// Squared departure per degree of freedom; 0 while too few readings are known for a prediction.
  [[nodiscard]] double surprise(const PredictedReading& reading) const;
  /// The same, computed as if the fit were exact. `known`: the uncertainty of the fit is small beside the
  /// noise.
  struct Exact {
    double surprise = 0;
    bool known = false;
  };
  [[nodiscard]] Exact exact(const PredictedReading& reading) const;

  /// A reading that was used; `cells` are asked for when it is time to fit anew.
  template <class Cells>
  void update(const PredictedReading& reading, Cells cells) {
    learn_noise(reading);
    if (++samples_ >= next_fit_) fit(cells());
  }
  void fit(const EllipsoidCells& cells);
  void set_fit(const SegmentsFit& fit);

  [[nodiscard]] const EllipsoidShape& shape() const { return shape_; }
  [[nodiscard]] SegmentNoise noise() const;
  [[nodiscard]] const SegmentBelief& belief() const { return belief_; }

  void archive(Archive& archive);

 private:
  void learn_noise(const PredictedReading& reading);
  [[nodiscard]] SegmentResidual residual(const PredictedReading& reading) const;

  double noise_uT_;
  SegmentBelief belief_;
  bool fitted_ = false;
  EllipsoidShape shape_;
  EllipsoidShape::Matrix covariance_ = EllipsoidShape::Matrix::Zero();
  double field_weight_ = 0, field_square_ = 0;  ///< of what the field's size departs, uT, with forgetting
  double tilt_weight_ = 0, tilt_square_ = 0;    ///< of what the dip departs, rad, with forgetting
  std::uint64_t samples_ = 0, next_fit_ = kFirstFit;

  static constexpr std::uint64_t kFirstFit = 60;
};

}  // namespace navcal::calib
