// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "web/record.h"

namespace navcal::web {

/// The controls of a recording that is played (docs/web.md). One thread.
class Player {
 public:
  virtual ~Player() = default;
  /// A JSON object with one of `play` (true, false), `seek` (seconds from the beginning) and `speed` (factor of
  /// the recorded speed). Anything else is ignored.
  virtual void command(std::string_view json) = 0;
  /// Somebody watches: a recording does not begin before.
  virtual void viewer_came() = 0;
  /// Appends the state as a JSON object: `file`, `playing`, `speed`, `position_s`, `duration_s`, `begin` (UTC, s).
  virtual void append_state(std::string& out) const = 0;
};

/// State of the connection from which records come.
struct Link {
  bool connected = false;
  std::string problem;  ///< why there is none, in words; empty while connected
};

/// One consumer of records. Its functions must not wait and must not destroy the subscriber.
class Subscriber {
 public:
  virtual ~Subscriber() = default;
  virtual void on_record(const Record& record) = 0;
  virtual void on_link(const Link& /*link*/) {}
  /// The topics are known, or have changed.
  virtual void on_topics() {}
  /// What was handed over before belongs to another recording, or to another place in it.
  virtual void on_forget() {}
};

/// Topics that a subscriber needs, and how often.
struct Demand {
  bool all_topics = false;
  std::set<std::string, std::less<>> topics;
  /// Most records a second for each topic and device; nullopt: every record.
  std::optional<double> rate_Hz = 0;
  /// The same for single topics that need another rate.
  std::map<std::string, std::optional<double>, std::less<>> topic_rate_Hz{};
};

/// Hands each record to all subscribers, and keeps the newest record of each topic and device for those who come
/// later. One thread; no ports.
class Hub {
 public:
  /// Called when what all subscribers need together has changed.
  using OnDemand = std::function<void(const Demand&)>;

  void publish(const Record& record);
  void set_link(Link link);
  void set_topics(std::vector<Topic> topics);
  /// Forgets the newest records: another recording, or another place in it.
  void forget();

  void add(Subscriber& subscriber, Demand demand);
  void change(Subscriber& subscriber, Demand demand);
  void remove(Subscriber& subscriber);

  [[nodiscard]] const Link& link() const { return link_; }
  [[nodiscard]] const std::vector<Topic>& topics() const { return topics_; }
  /// What all subscribers need together: each topic at the highest rate that one of them needs.
  [[nodiscard]] Demand demand() const;
  void on_demand(OnDemand on_demand) { on_demand_ = std::move(on_demand); }
  /// Hands out the newest record of each topic and device.
  void repeat_newest(const std::function<void(const Record&)>& take) const;
  [[nodiscard]] std::uint64_t published() const { return published_; }

 private:
  struct Kept {
    std::optional<std::int64_t> utc_ns;
    std::string message;
  };
  template <class Call>
  void tell(Call call);
  void tell_demand();

  std::map<Subscriber*, Demand> subscribers_;
  std::map<std::pair<std::string, std::string>, Kept> newest_;
  std::vector<Topic> topics_;
  Link link_{false, "not connected yet"};
  OnDemand on_demand_;
  std::uint64_t published_ = 0;
};

}  // namespace navcal::web
