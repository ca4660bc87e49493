// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/described/table_reader.h"
#include "config/layout.h"

// Parts of the reader of layouts.
namespace navcal::config::layout {

/// Greatest number of strips, and of points of a table.
inline constexpr std::size_t kMaxPoints = 200;

struct Bounds {
  double low, high;
  std::string_view unit = {};
};

/// Reads the numbers of one table into a layout. Every number may have a standard error and a range beside it:
/// mass_kg_std = 0.1, mass_kg_range = [5, 6]; every table may have a source.
class LayoutTable {
 public:
  LayoutTable(const Node& table, Layout& layout, std::vector<Problem>& problems);

  /// A missing number leaves `value` as it is.
  void number(std::string_view key, double& value, const Bounds& bounds);
  /// The same, of an angle that the file states in degrees.
  void angle(std::string_view key, double& value_rad, const Bounds& bounds_deg);
  /// As many numbers as there are in `values`.
  void numbers(std::string_view key, double* values, std::size_t count, const Bounds& bounds);
  template <std::size_t N>
  void numbers(std::string_view key, std::array<double, N>& values, const Bounds& bounds) {
    numbers(key, values.data(), N, bounds);
  }
  /// At most kMaxPoints numbers.
  void list(std::string_view key, std::vector<double>& values, const Bounds& bounds);
  /// A list, or one number for all `count` of them.
  void list_or_one(std::string_view key, std::vector<double>& values, std::size_t count, const Bounds& bounds);
  /// Six numbers of a diagonal, or 36.
  void matrix(std::string_view key, LayoutMatrix& values, const Bounds& bounds);
  /// A vector of any length above zero.
  void direction(std::string_view key, LayoutVector& value);
  /// Low and high, the first not above the second.
  void limits(std::string_view key, double& low, double& high, const Bounds& bounds);
  /// Strips: x_m, length_m, width_m and height_m (without it as high as wide).
  void strips(LayoutStrips& strips);
  /// The table [key] below this one; nullptr when there is none.
  [[nodiscard]] const Node* below(std::string_view key);

  [[nodiscard]] TableReader& reader() { return reader_; }
  /// Complains about every key that was not asked for.
  void finish() { reader_.finish(); }

 private:
  [[nodiscard]] const std::vector<double>* values_of(std::string_view key, std::string_view wanted);
  [[nodiscard]] bool are_within(std::string_view key, const std::vector<double>& values, const Bounds& bounds);
  /// `count`: numbers that the key has; of a matrix 36, whose standard errors may be those of its diagonal.
  void uncertainty(std::string_view key, const Bounds& bounds, std::size_t count = 1);

  const Node& table_;
  Layout& layout_;
  std::string name_;  ///< "body", "thruster[2]"; a single [ballast] is "ballast[1]"
  TableReader reader_;
};

void read_body(LayoutTable& table, LayoutBody& body, double density_kg_m3);
void read_added_mass(const Node& node, Layout& layout, std::vector<Problem>& problems);
void read_damping(const Node& node, Layout& layout, std::vector<Problem>& problems);
void read_thruster(const Node& node, Layout& layout, std::vector<Problem>& problems);
void read_surface(const Node& node, Layout& layout, std::vector<Problem>& problems);
void read_ballast(const Node& node, Layout& layout, std::vector<Problem>& problems);
void read_moving_mass(const Node& node, Layout& layout, std::vector<Problem>& problems);

}  // namespace navcal::config::layout
