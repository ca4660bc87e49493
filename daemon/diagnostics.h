// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::daemon {

/// Writes messages to standard error in a thread of its own, so that a blocked journal, a stopped pager or a
/// busy disk does not block the loop. A message that cannot be written for a second is dropped and counted; the
/// count is reported as soon as the reader reads again. (Messages that overrun the queue of 128 within that
/// second are lost, oldest first, and not counted.)
class Diagnostics {
 public:
  Diagnostics();
  /// Writes what waits; that takes no longer than a reader who does not read may hold up one message.
  ~Diagnostics();
  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;
};

}  // namespace navcal::daemon
