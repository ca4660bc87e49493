// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "control/order.h"

namespace navcal::control {

/// Follows lines from the wire until a status shows them. A status shows the newest line that had reached the card
/// when the status was measured and that has its shaft speed: the card has no echo of the fins. Older lines are
/// then superseded. Records come out in the order in which their lines were sent.
class EchoWatch {
 public:
  /// `timeout_s` 0: a line waits for ever, and none counts as not echoed. `transit_ns`: of a line on the wire.
  EchoWatch(double timeout_s, std::int64_t transit_ns);

  /// `record` has `sent_ns` and `sent`. Of very many lines that wait the oldest counts as superseded.
  void sent(OrderRecord record, std::vector<OrderRecord>& out);
  /// A status, measured at `validity_ns`, came at `arrival_ns`.
  void status(std::int64_t validity_ns, std::int64_t arrival_ns, const std::optional<double>& rpm_commanded,
              std::vector<OrderRecord>& out);
  /// Gives up lines whose time is over.
  void update(std::int64_t now_ns, std::vector<OrderRecord>& out);
  /// The port is gone or the program ends: no line is waited for any more.
  void give_up(std::vector<OrderRecord>& out);
  [[nodiscard]] std::int64_t deadline_ns() const;
  /// A line was given up, and none has been shown since.
  [[nodiscard]] bool is_deaf() const { return deaf_; }

 private:
  void pass_on_first(Outcome outcome, std::vector<OrderRecord>& out);

  std::int64_t timeout_ns_, transit_ns_;
  std::size_t capacity_;
  std::deque<OrderRecord> waiting_;
  bool deaf_ = false;
};

}  // namespace navcal::control
