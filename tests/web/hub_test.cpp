// SPDX-License-Identifier: Apache-2.0
#include "web/hub.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace navcal::web {
namespace {

struct Listener : Subscriber {
  void on_record(const Record& record) override { got.emplace_back(record.message); }
  void on_link(const Link& link) override { problem = link.problem; }
  std::vector<std::string> got;
  std::string problem;
};

Demand demand_of(std::set<std::string, std::less<>> topics, std::optional<double> rate_Hz) {
  return {false, std::move(topics), rate_Hz};
}

TEST(Hub, NewestOfEachTopicAndDeviceIsKeptForThoseWhoComeLater) {
  Hub hub;
  hub.publish({"/imu", "a", 1, "1"});
  hub.publish({"/imu", "b", 2, "2"});
  hub.publish({"/imu", "a", 3, "3"});
  Listener late;
  hub.repeat_newest([&](const Record& record) { late.on_record(record); });
  EXPECT_EQ(late.got, (std::vector<std::string>{"3", "2"}));
  hub.forget();
  hub.repeat_newest([&](const Record& record) { late.on_record(record); });
  EXPECT_EQ(late.got.size(), 2U);
}

TEST(Hub, DemandIsWhatAllSubscribersNeedTogether) {
  Hub hub;
  std::vector<Demand> told;
  hub.on_demand([&](const Demand& demand) { told.push_back(demand); });
  Listener page, bridge;
  hub.add(page, demand_of({"/nav"}, 20.0));
  EXPECT_EQ(told.back().rate_Hz, 20.0);
  hub.add(bridge, demand_of({"/imu"}, std::nullopt));
  EXPECT_FALSE(told.back().rate_Hz) << "one who needs every record decides";
  EXPECT_EQ(told.back().topics, (std::set<std::string, std::less<>>{"/imu", "/nav"}));
  using Rates = std::map<std::string, std::optional<double>, std::less<>>;
  EXPECT_EQ(told.back().topic_rate_Hz, (Rates{{"/nav", 20.0}})) << "its need does not raise the rate of others";
  hub.change(bridge, demand_of({"/imu"}, 1.0));
  EXPECT_EQ(told.back().rate_Hz, 20.0);
  EXPECT_EQ(told.back().topic_rate_Hz, (Rates{{"/imu", 1.0}}));
  hub.remove(page);
  hub.remove(bridge);
  EXPECT_TRUE(told.back().topics.empty());
  EXPECT_FALSE(told.back().all_topics);
}

TEST(Hub, OneWhoNeedsEveryRecordOfATopicDoesNotRaiseTheRateOfAllOthers) {
  Hub hub;
  Listener page, bridge;
  hub.add(page, {true, {}, 1.0});
  hub.add(bridge, demand_of({"/imu"}, std::nullopt));
  const Demand demand = hub.demand();
  EXPECT_TRUE(demand.all_topics);
  EXPECT_EQ(demand.rate_Hz, 1.0);
  ASSERT_TRUE(demand.topic_rate_Hz.contains("/imu"));
  EXPECT_FALSE(demand.topic_rate_Hz.at("/imu"));
  hub.change(bridge, demand_of({"/imu"}, 0.5));
  EXPECT_TRUE(hub.demand().topic_rate_Hz.empty()) << "the page needs more of it";
}

TEST(Hub, ASubscriberMayGoWhileItIsCalled) {
  struct Leaver : Listener {
    explicit Leaver(Hub& its_hub) : hub(its_hub) {}
    void on_record(const Record& record) override {
      Listener::on_record(record);
      hub.remove(*this);
    }
    Hub& hub;
  };
  Hub hub;
  Leaver first(hub), second(hub);
  Listener stays;
  for (Subscriber* one : std::initializer_list<Subscriber*>{&first, &second, &stays}) hub.add(*one, {});
  hub.publish({"/imu", "", 1, "1"});
  hub.publish({"/imu", "", 1, "2"});
  EXPECT_EQ(first.got.size() + second.got.size(), 2U);
  EXPECT_EQ(stays.got.size(), 2U);
}

TEST(Hub, WhatIsKeptIsBounded) {
  Hub hub;
  for (int i = 0; i < 5000; ++i) hub.publish({"/imu", std::to_string(i), 1, "x"});
  Listener late;
  hub.repeat_newest([&](const Record& record) { late.on_record(record); });
  EXPECT_EQ(late.got.size(), 1024U);
}

TEST(Hub, LossOfTheLinkIsToldWithItsReason) {
  Hub hub;
  Listener one;
  hub.add(one, {});
  hub.set_link({false, "refused"});
  EXPECT_EQ(one.problem, "refused");
  EXPECT_EQ(hub.link().problem, "refused");
}

}  // namespace
}  // namespace navcal::web
