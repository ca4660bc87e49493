// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "calib/archive.h"
#include "calib/magnetometer/ellipsoid_fit.h"

namespace navcal::calib {

/// How the residuals of neighbouring readings add up, at any shape. Both lines of the model are linear in
/// monomials of field and tilt: a sum of residuals over a block of readings is the product of coefficients, which
/// the shape gives, with the block's sum of monomials. Second moments of these sums, for blocks of several
/// lengths, are kept instead of the readings (batch means: Flegal and Jones, Annals of Statistics 38, 2010).
class ResidualBlocks {
 public:
  /// `down` is zero where the tilt is not known.
  void update(const Eigen::Vector3d& field_uT, const Eigen::Vector3d& down);
  /// Variance of a mean over that of independent residuals, at least 1: of the size of the field, of the dip.
  [[nodiscard]] double size_inflation(const EllipsoidShape& shape) const;
  [[nodiscard]] double dip_inflation(const EllipsoidShape& shape) const;
  void archive(Archive& archive);

 private:
  static constexpr std::array<std::uint32_t, 5> kLengths{1, 4, 16, 64, 256};

  template <int Size>
  struct Sums {
    using Vector = Eigen::Matrix<double, Size, 1>;
    using Matrix = Eigen::Matrix<double, Size, Size>;
    struct Scale {
      Vector block = Vector::Zero();
      Matrix square = Matrix::Zero();
      std::uint32_t in_block = 0;
      std::uint64_t blocks = 0;
      void archive(Archive& archive) { archive(block, square, in_block, blocks); }
    };
    std::array<Scale, kLengths.size()> scales;

    void add(const Vector& monomials);
    [[nodiscard]] double inflation(const Vector& coefficients) const;
    void archive(Archive& archive) { archive(scales); }
  };

  Sums<10> size_;
  Sums<13> dip_;
};

/// Noise of one reading by the scatter about the fit, `believed` being worth fifty readings. `so_far`: what was
/// found before, by which outliers are known.
[[nodiscard]] EllipsoidNoise fitted_noise(const EllipsoidShape& shape, const EllipsoidCells& cells,
                                          const ResidualBlocks& blocks, const EllipsoidNoise& believed,
                                          const EllipsoidNoise& so_far);

}  // namespace navcal::calib
