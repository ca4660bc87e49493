// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "web/outlets/signalk.h"

namespace navcal::web {
namespace {

using std::chrono::milliseconds;
constexpr SignalKSubscriptions::Clock::time_point kStart{std::chrono::hours(1)};
const std::string kOwnContext = "vessels.urn:mrn:imo:mmsi:230012345";

TEST(Pacer, AStreamAtJustTheRatePassesWhole) {
  Pacer pacer;
  int passed = 0;
  for (int i = 0; i < 100; ++i)
    passed += pacer.pass(kStart + milliseconds(100 * i + (i % 2) * 9), milliseconds(100));
  EXPECT_EQ(passed, 100);
}

TEST(Pacer, AFasterStreamIsThinnedToTheRate) {
  for (const int step_ms : {1, 7, 33, 50, 60, 99}) {
    Pacer pacer;
    int passed = 0;
    for (int t = 0; t < 10'000; t += step_ms) passed += pacer.pass(kStart + milliseconds(t), milliseconds(100));
    EXPECT_LE(passed, 112) << step_ms;
    EXPECT_GE(passed, 50) << step_ms;
  }
}

TEST(Pacer, ASilenceIsNotMadeUpFor) {
  Pacer pacer;
  EXPECT_TRUE(pacer.pass(kStart, milliseconds(100)));
  const auto later = kStart + milliseconds(10'000);
  EXPECT_TRUE(pacer.pass(later, milliseconds(100)));
  EXPECT_FALSE(pacer.pass(later + milliseconds(50), milliseconds(100)));
}

TEST(SignalKPattern, StarsStandForAnything) {
  for (const auto& [pattern, path] : {std::pair{"*", "navigation.position"},
                                      {"navigation.*", "navigation.position"},
                                      {"*.position", "navigation.position"},
                                      {"navigation.position", "navigation.position"},
                                      {"navigation.*.standardError", "navigation.headingTrue.standardError"},
                                      {"n*o*n", "navigation.position"},
                                      {"navigation.position*", "navigation.position"},
                                      {"**", "x"},
                                      {"*", ""},
                                      {"", ""}})
    EXPECT_TRUE(matches_pattern(pattern, path)) << pattern << " " << path;
  for (const auto& [pattern, path] : {std::pair{"navigation", "navigation.position"},
                                      {"*.heading", "navigation.headingTrue"},
                                      {"", "x"},
                                      {"navigation.*x", "navigation.position"},
                                      {"position", "navigation.position"}})
    EXPECT_FALSE(matches_pattern(pattern, path)) << pattern << " " << path;
}

TEST(SignalKPattern, ManyStarsCostNoTime) {
  std::string pattern;
  for (int i = 0; i < 100; ++i) pattern += "*a";
  EXPECT_FALSE(matches_pattern(pattern + "b", std::string(200, 'a')));
}

TEST(SignalKSubscriptions, NothingIsWantedBeforeItIsAskedFor) {
  SignalKSubscriptions subscriptions(kOwnContext);
  EXPECT_FALSE(subscriptions.is_due("navigation.position", kStart));
  EXPECT_TRUE(subscriptions.take(R"({"context":"vessels.self","subscribe":[{"path":"navigation.*"}]})").has_new);
  EXPECT_TRUE(subscriptions.is_due("navigation.position", kStart));
  EXPECT_FALSE(subscriptions.is_due("environment.current", kStart));
}

TEST(SignalKSubscriptions, OnlyThisVesselsContextsCount) {
  const auto accepted = [](const std::string& context) {
    SignalKSubscriptions subscriptions(kOwnContext);
    return subscriptions.take(R"({"context":)" + context + R"(,"subscribe":[{"path":"*"}]})").has_new;
  };
  for (const char* own :
       {R"("*")", R"("vessels.*")", R"("vessels.self")", R"("vessels.urn:mrn:imo:mmsi:230012345")"})
    EXPECT_TRUE(accepted(own)) << own;
  for (const char* other : {R"("vessels.urn:mrn:imo:mmsi:1")", R"("")", "7", "null", R"("aircraft.*")"})
    EXPECT_FALSE(accepted(other)) << other;
}

TEST(SignalKSubscriptions, PeriodsArePacedAndNeverBelowTheLimit) {
  const auto sent = [](const std::string& entry) {
    SignalKSubscriptions subscriptions(kOwnContext);
    EXPECT_TRUE(subscriptions.take(R"({"subscribe":[{"path":"*")" + entry + "}]}").has_new);
    int count = 0;
    for (int t = 0; t < 10'000; t += 10) count += subscriptions.is_due("a", kStart + milliseconds(t));
    return count;
  };
  EXPECT_NEAR(sent(R"(,"period":1000,"policy":"fixed")"), 10, 2);
  EXPECT_NEAR(sent(R"(,"period":1000)"), 10, 2);
  EXPECT_NEAR(sent(R"(,"minPeriod":500,"policy":"instant")"), 20, 3);
  for (const char* entry : {R"(,"policy":"instant")", R"(,"period":0)", R"(,"period":-5)",
                            R"(,"minPeriod":1,"policy":"ideal")", R"(,"period":"x")", R"(,"period":1e-300)"})
    EXPECT_NEAR(sent(entry), 100, 12) << entry;
  EXPECT_EQ(sent(R"(,"period":1e300)"), 1);
}

TEST(SignalKSubscriptions, EachPathHasItsOwnTurn) {
  SignalKSubscriptions subscriptions(kOwnContext);
  subscriptions.subscribe("*", milliseconds(100));
  EXPECT_TRUE(subscriptions.is_due("a", kStart));
  EXPECT_TRUE(subscriptions.is_due("b", kStart));
  EXPECT_FALSE(subscriptions.is_due("a", kStart + milliseconds(50)));
}

TEST(SignalKSubscriptions, UnsubscribingTakesBackWhatWasAskedFor) {
  SignalKSubscriptions subscriptions(kOwnContext);
  subscriptions.subscribe("*", milliseconds(100));
  const std::string some = R"({"subscribe":[{"path":"navigation.position"},{"path":"navigation.attitude"}]})";
  const std::string all = R"({"context":"*","unsubscribe":[{"path":"*"}])";
  EXPECT_FALSE(subscriptions.take(all + "}").has_new);
  EXPECT_EQ(subscriptions.patterns(), 0U);
  EXPECT_TRUE(subscriptions.take(some).has_new);
  EXPECT_FALSE(subscriptions.take(R"({"unsubscribe":[{"path":"navigation.position"}]})").has_new);
  EXPECT_FALSE(subscriptions.is_wanted("navigation.position"));
  EXPECT_TRUE(subscriptions.is_wanted("navigation.attitude"));
  EXPECT_TRUE(subscriptions.take(all + R"(,"subscribe":[{"path":"environment.*"}]})").has_new)
      << "both in one message";
  EXPECT_FALSE(subscriptions.is_wanted("navigation.attitude"));
  EXPECT_TRUE(subscriptions.is_wanted("environment.current"));
}

TEST(SignalKSubscriptions, ABadMessageChangesNothing) {
  SignalKSubscriptions subscriptions(kOwnContext);
  for (const char* text :
       {"", "{}", "[]", "null", "{", R"({"subscribe":7})", R"({"subscribe":{}})", R"({"subscribe":[7,null,[]]})",
        R"({"subscribe":[{"path":7}]})", R"({"subscribe":[{"path":""}]})", R"({"unsubscribe":"*"})"}) {
    const auto outcome = subscriptions.take(text);
    EXPECT_FALSE(outcome.has_new || outcome.reply) << text;
  }
  EXPECT_FALSE(subscriptions.take(R"({"subscribe":[{"path":")" + std::string(1000, '*') + R"("}]})").has_new);
  EXPECT_EQ(subscriptions.patterns(), 0U);
  for (int i = 0; i < 1000; ++i) subscriptions.subscribe("path" + std::to_string(i), milliseconds(100));
  EXPECT_EQ(subscriptions.patterns(), SignalKSubscriptions::kMaxPatterns);
}

TEST(SignalKSubscriptions, ARequestToChangeSomethingIsRefused) {
  SignalKSubscriptions subscriptions(kOwnContext);
  const auto outcome = subscriptions.take(R"({"requestId":"7-a","put":{"path":"steering.rudder","value":1}})");
  ASSERT_TRUE(outcome.reply);
  EXPECT_NE(outcome.reply->find("\"requestId\":\"7-a\""), std::string::npos);
  EXPECT_NE(outcome.reply->find("405"), std::string::npos);
  EXPECT_FALSE(subscriptions.take(R"({"put":{}})").reply) << "nobody waits for an answer";
}

}  // namespace
}  // namespace navcal::web
