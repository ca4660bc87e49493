// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "config/settings.h"
#include "pipeline/utc_mapping.h"
#include "protocols/frame.h"
#include "record/log/log_messages.h"

namespace navcal::record {

/// CRC-32C over a configuration as config::to_toml() writes it, eight hexadecimal digits: equal configurations
/// have equal sums.
[[nodiscard]] std::string config_sum(std::string_view config_toml);

enum class Direction : std::uint8_t { received = 0, sent = 1 };

/// Turns what happens into MCAP records (docs/log-format.md). Pure: appends bytes to a buffer, opens no file,
/// reads no clock; the disk thread takes the buffer. One encoder serves one file after another. log_time =
/// monotonic + one offset, fixed when the file is begun; publish_time = time of validity on that scale.
class LogEncoder : public LogMessages<LogEncoder, std::string&> {
 public:
  /// `config_toml`: the configuration in force, stored in /config.
  LogEncoder(const config::Settings& settings, std::string config_toml);
  ~LogEncoder();

  /// Starts a new file: magic, Header, Schemas, Channels, the configuration and the mapping in force.
  void begin(std::string& out, std::int64_t now_ns, const pipeline::UtcMapping& mapping);
  void raw(std::string& out, std::uint16_t port, Direction direction, std::int64_t time_ns,
           protocols::Bytes bytes);
  void put(std::string& out, const MessageHead& head, const AppendJson& append);
  [[nodiscard]] std::string_view port_name(std::uint16_t port) const;
  /// DataEnd, summary (schemas, channels, statistics), Footer, magic.
  void finish(std::string& out, std::int64_t now_ns);

  [[nodiscard]] std::uint64_t file_bytes() const;  ///< appended since begin()
  [[nodiscard]] std::uint64_t messages() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace navcal::record
