// SPDX-License-Identifier: Apache-2.0
#include "web/hub.h"

#include <algorithm>

namespace navcal::web {
namespace {

/// Bound of what is kept: more devices than this do not fit a vehicle, but a broken peer may name them.
constexpr std::size_t kMaxKept = 1024;

/// Nullopt is the highest.
std::optional<double> higher_rate(std::optional<double> a, std::optional<double> b) {
  return a && b ? std::optional(std::max(*a, *b)) : std::nullopt;
}

}  // namespace

/// By a copy of the pointers: a subscriber may add or remove others while it is called.
template <class Call>
void Hub::tell(Call call) {
  std::vector<Subscriber*> each;
  for (const auto& [subscriber, demand] : subscribers_) each.push_back(subscriber);
  for (Subscriber* subscriber : each) {
    if (subscribers_.contains(subscriber)) call(*subscriber);
  }
}

void Hub::publish(const Record& record) {
  ++published_;
  const std::pair key{std::string(record.topic), std::string(record.device)};
  if (newest_.size() < kMaxKept || newest_.contains(key)) {
    Kept& kept = newest_[key];
    kept.utc_ns = record.utc_ns;
    kept.message.assign(record.message);
  }
  tell([&](Subscriber& subscriber) { subscriber.on_record(record); });
}

void Hub::set_link(Link link) {
  link_ = std::move(link);
  tell([this](Subscriber& subscriber) { subscriber.on_link(link_); });
}

void Hub::set_topics(std::vector<Topic> topics) {
  topics_ = std::move(topics);
  tell([](Subscriber& subscriber) { subscriber.on_topics(); });
}

void Hub::forget() {
  newest_.clear();
  tell([](Subscriber& subscriber) { subscriber.on_forget(); });
}

void Hub::add(Subscriber& subscriber, Demand demand) {
  subscribers_[&subscriber] = std::move(demand);
  tell_demand();
}

void Hub::change(Subscriber& subscriber, Demand demand) {
  const auto found = subscribers_.find(&subscriber);
  if (found == subscribers_.end()) return;
  found->second = std::move(demand);
  tell_demand();
}

void Hub::remove(Subscriber& subscriber) {
  if (subscribers_.erase(&subscriber) > 0) tell_demand();
}

void Hub::tell_demand() {
  if (on_demand_) on_demand_(demand());
}

Demand Hub::demand() const {
  Demand all;
  for (const auto& [subscriber, one] : subscribers_) {
    all.all_topics = all.all_topics || one.all_topics;
    all.topics.insert(one.topics.begin(), one.topics.end());
  }
  // Topics that nobody names are needed by those who need all topics. Where nobody does, there are none.
  for (const auto& [subscriber, one] : subscribers_) {
    if (one.all_topics || !all.all_topics) all.rate_Hz = higher_rate(all.rate_Hz, one.rate_Hz);
  }
  for (const std::string& topic : all.topics) {
    std::optional<double> rate_Hz = 0;
    for (const auto& [subscriber, one] : subscribers_) {
      if (one.all_topics || one.topics.contains(topic)) rate_Hz = higher_rate(rate_Hz, one.rate_Hz);
    }
    if (rate_Hz != all.rate_Hz) all.topic_rate_Hz.emplace(topic, rate_Hz);
  }
  return all;
}

void Hub::repeat_newest(const std::function<void(const Record&)>& take) const {
  for (const auto& [key, kept] : newest_) {
    take({key.first, key.second, kept.utc_ns, kept.message});
  }
}

}  // namespace navcal::web
