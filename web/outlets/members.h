// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace navcal::web {

/// A row of members.txt: a member of a message under the name that another program has for it.
struct Member {
  std::string key, name, unit, help;
  double factor = 1;

  /// A number, or 1 and 0 for true and false; nullopt where the message has none.
  [[nodiscard]] std::optional<double> of(const nlohmann::json& message) const;
};
using Members = std::vector<Member>;

/// The rows of a message, in their order. Throws std::out_of_range for another message.
[[nodiscard]] const Members& members_of(const std::string& message);

}  // namespace navcal::web
