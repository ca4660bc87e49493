// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::record {

struct PlaceInDegrees {
  double lat = 0, lon = 0;
};

/// Where the vehicle was, by its own estimate.
class PositionTrack {
 public:
  void add(std::int64_t utc_ns, PlaceInDegrees place) { places_[utc_ns] = place; }
  /// Linear between the estimates before and after; nullopt where these are more than kFarthest_ns apart, and
  /// outside.
  [[nodiscard]] std::optional<PlaceInDegrees> at(std::int64_t utc_ns) const;

  static constexpr std::int64_t kFarthest_ns = 60'000'000'000;

 private:
  std::map<std::int64_t, PlaceInDegrees> places_;
};

/// Gives the samples of mission sensors the position of the vehicle at their time of validity, from the estimates
/// in the same log. The log is read for them when the first sample comes, so that one without such samples is read
/// once.
class SensorPlaces {
 public:
  explicit SensorPlaces(std::filesystem::path log_file) : log_file_(std::move(log_file)) {}

  /// `json` with the members "lat" and "lon" where the position is known. Throws as LogReader does.
  [[nodiscard]] std::string placed(std::string_view json);

 private:
  std::filesystem::path log_file_;
  std::optional<PositionTrack> track_;
};

}  // namespace navcal::record
