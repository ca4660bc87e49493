// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "web/record.h"

namespace navcal::web {

/// One path with its value in the units of Signal K: SI, radians, degrees of latitude and longitude.
struct SignalKValue {
  std::string path;
  nlohmann::json value;  ///< null: not known any more
};

/// What one record says, for Signal K.
struct SignalKUpdate {
  std::string device;
  std::optional<std::int64_t> utc_ns;  ///< time of validity
  std::vector<SignalKValue> values;
};

/// Units and description of a path (`meta`). Null for a path that this program does not send.
[[nodiscard]] nlohmann::json signalk_meta(std::string_view path);

/// Turns records of the log into values of Signal K, and keeps the newest of each path. A path whose value has
/// gone is told once, with null.
class SignalKModel {
 public:
  /// Topics that it reads.
  static constexpr std::string_view kTopics[] = {"/nav", "/compass", "/imu", "/battery", "/health"};

  /// Without values when the record says nothing new, or its message has another shape.
  [[nodiscard]] SignalKUpdate take(const Record& record);
  /// All that was known is not known any more: null for each path.
  [[nodiscard]] SignalKUpdate forget();
  /// The newest values, those of one record together.
  [[nodiscard]] std::vector<SignalKUpdate> newest() const;

 private:
  struct Kept {
    std::string device;
    std::optional<std::int64_t> utc_ns;
    nlohmann::json value;
  };
  using Values = std::vector<SignalKValue>;
  void take_health(const nlohmann::json& health);
  [[nodiscard]] Values navigation(const nlohmann::json& nav) const;
  [[nodiscard]] Values compass(const nlohmann::json& compass) const;
  [[nodiscard]] bool serves(std::string_view role, std::string_view device) const;

  std::map<std::string, Kept, std::less<>> newest_;          ///< by path
  std::map<std::string, std::string, std::less<>> sources_;  ///< device of each role
  std::optional<double> declination_rad_;
};

}  // namespace navcal::web
