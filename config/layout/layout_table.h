// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/described/table_reader.h"
#include "config/layout/members.h"

// Parts of the reader of layouts.
namespace navcal::config::layout {

/// Greatest number of strips, and of points of a table.
inline constexpr std::size_t kMaxPoints = 200;

/// Reads the numbers of one table into a layout. Every number may have a standard error and a range beside it:
/// mass_kg_std = 0.1, mass_kg_range = [5, 6]; every table may have a source.
class LayoutTable {
 public:
  static constexpr bool kReads = true;
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
  void matrix(std::string_view key, LayoutMatrix& values, const Bounds& bounds, bool is_symmetric = false);
  /// A vector of any length above zero.
  void direction(std::string_view key, LayoutVector& value, bool is_setting = false);
  /// Low and high, the first not above the second.
  void limits(std::string_view key, double& low, double& high, const Bounds& bounds);
  /// Strips: x_m, length_m, width_m and height_m (without it as high as wide).
  void strips(LayoutStrips& strips);
  /// Of a file, the member is read whatever its usual value.
  void number_unless(double, std::string_view key, double& value, const Bounds& bounds) {
    number(key, value, bounds);
  }
  void angle_unless(double, std::string_view key, double& value, const Bounds& bounds) {
    angle(key, value, bounds);
  }
  template <std::size_t N>
  void numbers_unless(const std::array<double, N>&, std::string_view key, std::array<double, N>& values,
                      const Bounds& bounds) {
    numbers(key, values, bounds);
  }
  /// Name, which no actuator before it may have, and channel. One without a usual name has to have its own.
  template <class Actuator>
  void identity(Actuator& actuator, std::string_view usual_name) {
    actuator.name = usual_name;
    read_identity(actuator.name, actuator.channel, usual_name.empty());
  }
  /// Unit of the command, with its usual limits.
  void command(LayoutThruster& thruster);
  void hand(bool& is_left) { is_left = reader_.choice("hand", {"right", "left"}) == "left"; }
  /// `first` where the file has the key, else `second`.
  void either(std::string_view key, bool, auto first, auto second) { reader_.has(key) ? first() : second(); }
  /// The table [key] below this one, where there is one.
  void part(std::string_view key, bool, auto members) {
    if (const Node* node = below(key)) read(*node, members);
  }
  template <class Part>
  void part(std::string_view key, std::optional<Part>& value, auto members) {
    if (const Node* node = below(key)) read(*node, [&](LayoutTable& table) { members(table, value.emplace()); });
  }
  void read(const Node& node, auto members) {
    LayoutTable table(node, layout_, problems_);
    members(table);
    table.finish();
  }
  void require(std::string_view key, std::string_view what) { reader_.require(key, what); }
  [[nodiscard]] const Layout& layout() const { return layout_; }

  [[nodiscard]] TableReader& reader() { return reader_; }
  /// Complains about every key that was not asked for.
  void finish() { reader_.finish(); }

 private:
  [[nodiscard]] const Node* below(std::string_view key);
  void read_identity(std::string& name, std::string& channel, bool needs_name);
  [[nodiscard]] const std::vector<double>* values_of(std::string_view key, std::string_view wanted);
  [[nodiscard]] bool are_within(std::string_view key, const std::vector<double>& values, const Bounds& bounds);
  /// `count`: numbers that the key has; of a matrix 36, whose standard errors may be those of its diagonal.
  void uncertainty(std::string_view key, const Bounds& bounds, std::size_t count = 1);

  const Node& table_;
  Layout& layout_;
  std::vector<Problem>& problems_;
  std::string name_;  ///< "body", "thruster[2]"; a single [ballast] is "ballast[1]"
  TableReader reader_;
};

}  // namespace navcal::config::layout
