// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/field_cells.h"

#include <algorithm>

namespace navcal::calib {
namespace {

/// Chan, Golub and LeVeque, The American Statistician 37 (1983): sums about the mean, without cancellation.
template <class Cell, class Vector, class Matrix>
void merge(Cell& into, double count, const Vector& mean, const Matrix& scatter) {
  const double total = into.count + count;
  const Vector apart = mean - into.mean;
  into.scatter += scatter + (into.count * count / total) * apart * apart.transpose();
  into.mean += (count / total) * apart;
  into.count = total;
}

}  // namespace

template <int Keys, int Features>
std::size_t FieldCells<Keys, Features>::find(const Key& key, std::size_t end) const {
  const auto last = cells_.begin() + static_cast<std::ptrdiff_t>(end);
  return static_cast<std::size_t>(
      std::find_if(cells_.begin(), last, [&](const Cell& cell) { return cell.key == key; }) - cells_.begin());
}

template <int Keys, int Features>
void FieldCells<Keys, Features>::add(const Vector& reading) {
  Cell cell;
  cell.count = 1;
  cell.mean = reading;
  add(cell);
}

template <int Keys, int Features>
void FieldCells<Keys, Features>::add(const Cell& cell) {
  Key key;
  for (int i = 0; i < Keys; ++i) {
    key[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(std::floor(cell.mean[i] / size_));
  }
  std::size_t index = newest_;
  if (index >= cells_.size() || cells_[index].key != key) index = find(key, cells_.size());
  if (index == cells_.size()) {
    cells_.emplace_back();
    cells_.back().key = key;
  }
  newest_ = index;
  merge(cells_[index], cell.count, cell.mean, cell.scatter);
  while (cells_.size() > kCapacity) double_size();
}

template <int Keys, int Features>
void FieldCells<Keys, Features>::double_size() {
  size_ *= 2;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    Cell cell = cells_[i];
    for (auto& k : cell.key) k = k >> 1;  // towards minus infinity, as floor
    const std::size_t same = find(cell.key, kept);
    if (same < kept) {
      merge(cells_[same], cell.count, cell.mean, cell.scatter);
    } else {
      cells_[kept++] = cell;
    }
  }
  cells_.resize(kept);
  newest_ = kept;
}

template class FieldCells<2, 4>;
template class FieldCells<3, 6>;

}  // namespace navcal::calib
