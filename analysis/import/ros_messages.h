// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "analysis/import/import_sink.h"
#include "analysis/import/port_name.h"

namespace navcal::analysis::ros {

/// A topic of a bag whose messages are taken.
struct Topic {
  std::string name;
  int instance = 0;  ///< 0 for the first topic of its kind
};

/// Decodes one message in CDR and hands its samples to the sink; false when it is shorter than its type.
using Decoder = bool (*)(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink);

struct MessageType {
  std::string name;  ///< "sensor_msgs/msg/Imu"
  PortKind kind;
  Decoder decode;
};

/// Sample of a message; the stamp of its header is its time where it lies within an hour of the log's.
[[nodiscard]] ImportedSample sample_of(const Topic& topic, PortKind kind, std::int64_t log_time_ns,
                                       std::int64_t stamp_ns);

/// nullptr for a type that is not taken.
[[nodiscard]] const MessageType* message_type(std::string_view name);

}  // namespace navcal::analysis::ros
