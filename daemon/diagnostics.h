// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::daemon {

/// Messages go to standard error by a thread of their own: neither a journal that stands still, nor a pager that
/// somebody has piped them to, nor a busy disk holds up the loop. What cannot be written for a second is dropped
/// and counted; the count is said as soon as somebody reads again. (What overruns the queue of 128 within that
/// second is lost, oldest first, and not in the count.)
class Diagnostics {
 public:
  Diagnostics();
  /// Writes what waits; that takes no longer than a reader who does not read may hold up one message.
  ~Diagnostics();
  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;
};

}  // namespace navcal::daemon
