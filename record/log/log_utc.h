// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "pipeline/utc_mapping.h"
#include "record/log/log_reader.h"

namespace navcal::record {

/// One scale of UTC for all times of a log. A computer whose clock needs its supply does not know UTC when it
/// starts, and navcald finds it later. The best kind of mapping in the file then holds for what was logged before,
/// too.
class LogUtc {
 public:
  LogUtc() = default;  ///< takes each mapping as it comes
  /// Reads the file up to its first mapping with a bound. A pipe, which can be read only once, is left alone.
  explicit LogUtc(const std::filesystem::path& file);

  /// The mapping that holds where the log has this one.
  [[nodiscard]] const pipeline::UtcMapping& in_place_of(const pipeline::UtcMapping& logged) const;

  /// Whether mapping() leads to UTC; otherwise to the time since the computer was started.
  [[nodiscard]] bool is_known() const;

  /// A JSON message with its times on the scale; its checksum is that of the log. Valid until the next call.
  /// Takes the log's messages in their order, those of /time too.
  [[nodiscard]] std::string_view on_scale(const LogMessage& message, const LogReader& log);
  /// The mapping for the messages after the last one taken.
  [[nodiscard]] const pipeline::UtcMapping& mapping() const { return in_place_of(logged_); }

 private:
  pipeline::UtcMapping best_, logged_, before_;
  std::string text_;
};

}  // namespace navcal::record
