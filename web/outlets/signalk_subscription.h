// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "web/outlets/pacer.h"

namespace navcal::web {

/// True when `path` is what `pattern` says, in which * stands for any characters, also dots and none.
[[nodiscard]] bool matches_pattern(std::string_view pattern, std::string_view path);

/// What one Signal K client wants, by its messages `subscribe` and `unsubscribe`.
class SignalKSubscriptions {
 public:
  using Clock = Pacer::Clock;
  /// No path is sent more often.
  static constexpr std::chrono::milliseconds kMinPeriod{100};
  static constexpr std::size_t kMaxPatterns = 64;

  /// `self`: the context of this vessel, "vessels.urn:...".
  explicit SignalKSubscriptions(std::string self) : self_(std::move(self)) {}

  /// What a message of the client has changed or asks for.
  struct Outcome {
    bool has_new = false;              ///< there are new subscriptions: their newest values are due
    std::optional<std::string> reply;  ///< to a request that this server does not serve
  };
  /// Any text; what is not understood changes nothing.
  [[nodiscard]] Outcome take(std::string_view message);

  void subscribe(std::string pattern, Clock::duration period);
  /// True when the path is wanted and its time has come.
  [[nodiscard]] bool is_due(std::string_view path, Clock::time_point now);
  [[nodiscard]] bool is_wanted(std::string_view path) const { return period_of(path).has_value(); }
  [[nodiscard]] std::size_t patterns() const { return wanted_.size(); }

 private:
  struct Wanted {
    std::string pattern;
    Clock::duration period;
  };
  [[nodiscard]] bool is_self(const nlohmann::json& message) const;
  [[nodiscard]] bool take_subscribe(const nlohmann::json& list);
  void take_unsubscribe(const nlohmann::json& list);
  [[nodiscard]] std::optional<Clock::duration> period_of(std::string_view path) const;

  std::string self_;
  std::vector<Wanted> wanted_;
  std::map<std::string, Pacer, std::less<>> pacers_;  ///< by path
};

}  // namespace navcal::web
