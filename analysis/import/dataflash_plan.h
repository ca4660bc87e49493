// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/import/dataflash_table.h"

namespace navcal::analysis::dataflash {

enum class Kind : std::uint8_t {
  imu,
  mag,
  baro,
  gps,
  gps_accuracy,
  attitude,
  state_variances,
  battery,
  outputs,
  parameter,
  text,
  other
};

/// Kind of a message by its name; `instance` is 1 for IMU2, and so on.
struct KindOfName {
  Kind kind = Kind::other;
  int instance = 0;
};
[[nodiscard]] KindOfName kind_of(std::string_view name);

/// The columns of one message type that are used, bound to a version of the table.
class Plan {
 public:
  static constexpr std::size_t kMostFields = 12;

  Plan() = default;
  /// Never fails; a message that cannot be used says why.
  Plan(const Table& table, const MessageType& type);

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Empty when the message can be used: "unit \"Pa\" of MagX is not one of a field".
  [[nodiscard]] const std::string& why_not() const { return why_not_; }

  [[nodiscard]] std::optional<std::int64_t> time_ns(std::string_view record) const;
  [[nodiscard]] int instance(std::string_view record) const;
  /// Field `i` of the kind (fields_of() in the source), in navcal's unit; nullopt when the log does not have it.
  [[nodiscard]] std::optional<double> field(const Table& table, std::string_view record, std::size_t i) const;
  /// Whole number of field `i`, its multiplier not applied.
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view record, std::size_t i) const;
  [[nodiscard]] std::string_view text(std::string_view record, std::size_t i) const;
  /// Columns C1, C2, ... of RCOU, in order.
  [[nodiscard]] const std::vector<const Column*>& channels() const { return channels_; }

 private:
  struct Bound {
    const Column* column = nullptr;
    double factor = 1;
  };

  std::uint64_t version_ = 0;
  Kind kind_ = Kind::other;
  int instance_of_name_ = 0;
  const Column* time_ = nullptr;
  std::int64_t time_unit_ns_ = 1000;
  const Column* instance_ = nullptr;
  std::array<Bound, kMostFields> fields_{};
  std::vector<const Column*> channels_;
  std::string why_not_;
};

}  // namespace navcal::analysis::dataflash
