// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::web {

/// One message of a topic of the log (docs/log-format.md): `message` is the JSON text that the log gets.
struct Record {
  std::string_view topic;
  std::string_view device;             ///< port name; empty where the topic belongs to no device
  std::optional<std::int64_t> utc_ns;  ///< time of validity; absent while UTC is unknown
  std::string_view message;
};

/// A topic that records may belong to, as the log describes it.
struct Topic {
  std::string name;
  std::string schema_name;
  std::string schema;  ///< JSON schema
};

/// Reads a line of class RECORD of the status socket. Nullopt for any other line. The views point into `line`.
[[nodiscard]] std::optional<Record> read_record(std::string_view line);

}  // namespace navcal::web
