// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "control/order.h"

namespace navcal::control {

inline constexpr int kMaxPriority = 1000;
inline constexpr std::size_t kMaxHolderLength = 64;

struct LeaseRequest {
  std::string holder;
  int priority = 0;
  double timeout_s = 0;
};

/// Holder of the lease.
struct Holder {
  std::string name;
  int priority = 0;
  double timeout_s = 0;
  std::int64_t expires_ns = kNever_ns;
  std::uint64_t client = 0;  ///< the connection that asked
  std::string token;
};

/// "operator (priority 2)".
[[nodiscard]] std::string words_for(const Holder& holder);

/// One holder at a time. A higher priority takes over; an equal or lower one does not, unless the same connection
/// asks anew. Remembers why the last leases ended, so that their holders can be told.
class LeaseDesk {
 public:
  /// Why the request is refused; empty: granted, from now on under `token`.
  [[nodiscard]] std::string grant(std::int64_t now_ns, const LeaseRequest& request, std::string token,
                                  std::uint64_t client);
  /// Why a token is not the holder's; empty: it is.
  [[nodiscard]] std::string problem_with(std::string_view token) const;
  /// The holder has just given an order.
  void renew(std::int64_t now_ns);
  /// Nobody is in charge any more; `reason` is what the former holder's next order hears.
  void end(std::string reason);

  [[nodiscard]] const std::optional<Holder>& holder() const { return holder_; }

 private:
  static constexpr std::size_t kRemembered = 16;

  std::optional<Holder> holder_;
  std::deque<std::pair<std::string, std::string>> ended_;  ///< tokens with why they ended, the newest first
};

}  // namespace navcal::control
