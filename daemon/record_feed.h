// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.h"
#include "daemon/status_server.h"
#include "record/log/log_messages.h"

namespace navcal::daemon {

/// Sends RECORD, the log's JSON messages, to the clients of the status socket that ask for it
/// (docs/status-protocol.md). Nothing is encoded while nobody asks. Times are monotonic nanoseconds.
class RecordFeed {
 public:
  RecordFeed(const config::Settings& settings, StatusServer& server);

  /// `utc_ns`: time of validity.
  void publish(const record::MessageHead& head, std::int64_t utc_ns, const record::AppendJson& append);

 private:
  StatusServer& server_;
  std::vector<std::string> devices_;  ///< names of the ports
  std::string line_;
};

}  // namespace navcal::daemon
