// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "gap/watch/watch.h"

namespace navcal::report {

/// Facts of a watch that every reader of its events needs once.
struct WatchStart {
  std::string vehicle;  ///< file
  std::string source;   ///< recording, or address of the daemon
  double false_alarms_per_h = 0;
  double threshold_nats = 0;
  int reference_missions = 0, reference_windows = 0;
  std::uint64_t restored_windows = 0;  ///< that an earlier run judged
  std::string state_refused;           ///< why a state was not taken up; empty: it was, or there is none
};

/// One JSON object without a newline: the event `began`.
[[nodiscard]] std::string watch_began_json(const WatchStart& start);

/// One JSON object without a newline: `alarm`, `cause`, `unknown`, `skipped`, or `status` for a judged window.
/// docs/gap-watch.md lists the keys.
[[nodiscard]] std::string watch_event_json(const gap::WatchEvent& event, const gap::WatchReport& report);

/// One JSON object without a newline: something about the watch itself, such as `disconnected`.
[[nodiscard]] std::string watch_notice_json(std::string_view event, std::string_view reason);

/// State of a watch in the text format of Prometheus, for the textfile collector of node_exporter.
[[nodiscard]] std::string watch_metrics(const gap::WatchReport& report);

}  // namespace navcal::report
