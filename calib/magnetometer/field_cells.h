// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "calib/archive.h"

namespace navcal::calib {

/// Edge of a cell: readings of one cell are summed, and their spread within it is below the noise of a reading.
inline constexpr double kCellSize_uT = 0.7;

/// Larger than any sum of the Earth's field and a vehicle's iron. Readings above it are left out.
inline constexpr double kHighestField_uT = 500;

/// Bounded summary of readings: cubes of the space of the first `Keys` features, each with the count, mean and
/// second moments of all `Features`. When they are more than kCapacity, cubes of twice the size take their place,
/// which loses nothing of the sums. A cube of raw field needs no centre, so an offset larger than the field does
/// no harm; second moments let a fit see the arc within a cube rather than its chord.
template <int Keys, int Features>
class FieldCells {
 public:
  using Vector = Eigen::Matrix<double, Features, 1>;
  using Matrix = Eigen::Matrix<double, Features, Features>;
  using Key = std::array<std::int32_t, Keys>;
  struct Cell {
    Key key{};
    double count = 0;
    Vector mean = Vector::Zero();
    Matrix scatter = Matrix::Zero();  ///< sum of squares about the mean
    void archive(Archive& archive) { archive(key, count, mean, scatter); }
  };
  static constexpr std::size_t kCapacity = Keys == 2 ? 256 : 512;

  explicit FieldCells(double size) : size_(size) { cells_.reserve(kCapacity + 1); }

  void add(const Vector& reading);
  /// A summary of readings, by a cell of another summary.
  void add(const Cell& cell);
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] double size() const { return size_; }
  void archive(Archive& archive) { archive(size_, newest_, cells_); }

 private:
  [[nodiscard]] std::size_t find(const Key& key, std::size_t end) const;
  void double_size();

  double size_;
  std::uint64_t newest_ = 0;  ///< cell of the last reading; the next one often follows it
  std::vector<Cell> cells_;
};

extern template class FieldCells<2, 4>;
extern template class FieldCells<3, 6>;

}  // namespace navcal::calib
