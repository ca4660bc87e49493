// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace navcal::record {

/// Not a number for a text that is none.
[[nodiscard]] double number_or_nan(std::string_view text);

/// The scalar members of a JSON object, as text: numbers keep every digit they were written with, null is empty.
/// What lies deeper has a dotted name: "fins_rad.0", "ports.1.name".
class FlatJson {
 public:
  /// nullopt when it is not one whole JSON object.
  static std::optional<FlatJson> parse(std::string_view json);

  /// Null when there is no such member.
  [[nodiscard]] const std::string* find(std::string_view name) const;
  [[nodiscard]] std::string_view get(std::string_view name) const;

 private:
  std::vector<std::pair<std::string, std::string>> members_;
};

}  // namespace navcal::record
