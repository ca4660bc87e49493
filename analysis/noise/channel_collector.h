// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/noise/noise_run.h"
#include "pipeline/pipeline.h"

namespace navcal::analysis {

/// Sorts samples into the channels of each port. Values that are not finite are left out, angles are unwrapped,
/// and the first 10 s of fixes after 10 s without one are left out: they are noisier than settled ones.
class ChannelCollector final : public pipeline::Sink {
 public:
  void on_sample(const instruments::Sample& sample) override;

  /// From the first sample to the newest, by times of validity.
  [[nodiscard]] double duration_s() const { return end_s_; }
  /// Time of the first sample by the newest mapping to UTC.
  [[nodiscard]] std::int64_t begin_utc_ns() const { return begin_utc_ns_; }
  /// The channels in the order of ports and table, without their noise. The collector is empty then.
  [[nodiscard]] std::vector<RecordedChannel> take_channels(const config::Settings& settings);

 private:
  struct Key {
    std::uint16_t port = 0;
    std::size_t row = 0;  ///< of the table; after its end: a mission sensor
    std::string quantity;
    auto operator<=>(const Key&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs
  };
  struct Kept {
    std::string unit;
    Series series;
  };
  struct Receiver {
    ChannelOrigin origin;
    double first_s = 0, newest_s = 0;  ///< of the fixes without a pause
  };

  static const NoiseChannel& row_of(const Key& key);
  bool is_settled(std::uint16_t port, const instruments::GpsSample& gps, double time_s);
  void add(Key key, std::string_view unit, double time_s, double value);

  std::optional<std::int64_t> begin_ns_;
  std::int64_t begin_utc_ns_ = 0;
  double end_s_ = 0;
  std::map<std::uint16_t, Receiver> receivers_;
  std::map<Key, Kept> channels_;
};

}  // namespace navcal::analysis
