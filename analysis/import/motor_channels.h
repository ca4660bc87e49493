// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/import/import_sink.h"
#include "config/csv_map.h"

namespace navcal::analysis {

/// Channels of another system's log of which a map makes shaft and fins ("RCOU.C1", docs/import.md). A channel is
/// named by its message and its member, with a point between them.
class MotorChannels {
 public:
  MotorChannels() = default;
  explicit MotorChannels(config::ChannelMap map);

  /// Whether the map names a channel of this message.
  [[nodiscard]] bool has(std::string_view message) const { return groups_.find(message) != groups_.end(); }
  [[nodiscard]] bool has(std::string_view message, std::string_view member) const;
  /// Number of a member; nullopt where the message does not have it.
  using MemberReader = std::function<std::optional<double>(std::string_view member)>;
  /// Gives a MOTOR sample for each instrument of the map that this message has a value for, at the times of
  /// `sample`. False: none.
  bool emit(std::string_view message, const MemberReader& read, const ImportedSample& sample, ImportSink& sink);

  /// Throws config::Error by line and key of the map when a channel has never had a value.
  void expect_all_found() const;
  /// Values beyond the map's curves: "RCOU.C1: 12 values beyond 1100 to 1900 ...".
  [[nodiscard]] std::vector<std::string> remarks() const;

 private:
  struct Channel {
    config::CsvColumn column;
    std::string member;
    std::uint64_t values = 0, beyond = 0;
  };
  /// The channels of one message that one instrument has.
  struct Group {
    std::string name;  ///< of the message, in the report of the import
    std::string_view port;
    std::vector<Channel> channels;
  };

  std::map<std::string, std::vector<Group>, std::less<>> groups_;
  std::string file_;
};

}  // namespace navcal::analysis
