// SPDX-License-Identifier: Apache-2.0
// Both ends of a link over a simulated line in virtual time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/link/channel.h"

namespace navcal::link {
namespace {

constexpr std::string_view kSecret = "the same secret on both sides";

std::string text_of(unsigned number, std::size_t length) {
  std::string text = fmt::format("{}:", number);
  while (text.size() < length) text += static_cast<char>('a' + (text.size() * 7 + number) % 26);
  return text;
}

struct Line {
  const char* name;
  Defects defects;
};

const Line kLines[] = {
    {"perfect", {}},
    {"loss of 10 %", {.loss = 0.1, .latency_s = 0.05}},
    {"loss of 30 %", {.loss = 0.3, .latency_s = 0.05}},
    {"latency of a second", {.latency_s = 1}},
    {"loss of 30 %, latency of a second, everything else",
     {.loss = 0.3,
      .repeat = 0.1,
      .truncate = 0.05,
      .flip = 0.05,
      .garbage = 0.1,
      .latency_s = 1,
      .jitter_s = 0.5}},
    {"repetition and reordering", {.repeat = 0.5, .jitter_s = 1}},
};

/// Answers every request with its text twice, and notes it.
void serve(World& world, std::vector<std::string>& executed, std::size_t answer_length = 0) {
  world.work = [&world, &executed, answer_length] {
    while (auto request = world.vehicle.take_request()) {
      executed.push_back(*request);
      std::string answer = "re " + *request;
      if (answer_length > answer.size()) answer.resize(answer_length, '.');
      EXPECT_TRUE(world.vehicle.respond(answer));
    }
  };
}

TEST(LinkSession, EveryRequestIsExecutedOnceInOrderAndAnsweredOnWhateverLine) {
  for (const Line& line : kLines) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(fmt::format("{}, seed {}", line.name, seed));
      World world(line.defects, seed, World::with_key(kSecret), World::with_key(kSecret));
      std::vector<std::string> executed, answers, wanted, wanted_answers;
      serve(world, executed);
      ASSERT_TRUE(world.connect());
      for (unsigned i = 0; i < 30; ++i) {
        wanted.push_back(text_of(i, i % 7 == 6 ? 4096 : 3 + 41 * i % 700));
        wanted_answers.push_back("re " + wanted.back());
        ASSERT_TRUE(world.host.request(wanted.back()));
      }
      const bool is_done = world.run(600, [&] {
        while (auto answer = world.host.take_response()) answers.push_back(*answer);
        return answers.size() >= wanted.size();
      });
      EXPECT_TRUE(is_done) << answers.size() << " answers";
      world.run(20);
      while (auto answer = world.host.take_response()) answers.push_back(*answer);
      ASSERT_EQ(executed, wanted);
      ASSERT_EQ(answers, wanted_answers);
      EXPECT_EQ(world.host.sessions(), 1U);
    }
  }
}

TEST(LinkSession, AnAnswerOfAnyLengthComesWhole) {
  World world({.loss = 0.3, .latency_s = 0.2}, 3);
  std::vector<std::string> executed;
  serve(world, executed, 100'000);
  ASSERT_TRUE(world.connect());
  ASSERT_TRUE(world.host.request("long"));
  std::optional<std::string> answer;
  ASSERT_TRUE(world.run(400, [&] { return (answer = world.host.take_response()).has_value(); }));
  EXPECT_EQ(answer->size(), 100'000U);
  EXPECT_TRUE(answer->starts_with("re long..."));
  EXPECT_FALSE(world.vehicle.respond(std::string(kMaxMessage + 1, '.'))) << "this is longer than the link takes";
}

TEST(LinkSession, TheNewestOrderWinsAndNoneIsExecutedTwice) {
  for (const Line& line : kLines) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(fmt::format("{}, seed {}", line.name, seed));
      World world(line.defects, seed, World::with_key(kSecret), World::with_key(kSecret));
      std::vector<int> executed;
      world.work = [&] {
        if (const auto command = world.vehicle.take_command()) {
          executed.push_back(static_cast<int>(command->shaft_rpm));
          world.vehicle.answer({command->number, true, false, ""});
        }
      };
      ASSERT_TRUE(world.connect());
      for (int rpm = 1; rpm <= 40; ++rpm) {
        Command order;
        order.kind = Command::Kind::order;
        order.shaft_rpm = rpm;
        ASSERT_TRUE(world.host.command(world.now_ns, order));
        world.run(0.3);
      }
      ASSERT_TRUE(world.run(10, [&] { return !executed.empty() && executed.back() == 40; }));
      world.run(10);
      for (std::size_t i = 1; i < executed.size(); ++i) EXPECT_LT(executed[i - 1], executed[i]);
      EXPECT_EQ(executed.back(), 40);
      EXPECT_GT(executed.size(), 15U);
    }
  }
}

TEST(LinkSession, AnOrderDoesNotWaitForTheStream) {
  World world({}, 1);
  std::vector<std::string> executed;
  serve(world, executed, 60'000);
  const auto requests = world.work;
  std::int64_t order_ns = 0;
  world.work = [&] {
    requests();
    if (const auto command = world.vehicle.take_command()) {
      order_ns = world.now_ns;
      world.vehicle.answer({command->number, true, false, ""});
    }
  };
  ASSERT_TRUE(world.connect());
  for (unsigned i = 0; i < 20; ++i) ASSERT_TRUE(world.host.request(text_of(i, 4000)));
  world.run(10);
  for (int i = 0; i < 20; ++i) {
    const std::int64_t asked_ns = world.now_ns;
    Command order;
    order.kind = Command::Kind::order;
    ASSERT_TRUE(world.host.command(world.now_ns, order));
    order_ns = 0;
    std::int64_t answered_ns = 0;
    ASSERT_TRUE(world.run(2, [&] {
      if (world.host.take_answer()) answered_ns = world.now_ns;
      return answered_ns != 0;
    }));
    // One frame of the stream may be on the wire before it, in each direction.
    EXPECT_LT(order_ns - asked_ns, 100'000'000);
    EXPECT_LT(answered_ns - asked_ns, 200'000'000);
    world.run(0.5);
  }
}

TEST(LinkSession, BothEndsHoldTheirBudget) {
  EndOptions options;
  options.budget_B_s = 1500;
  World world({.loss = 0.2}, 2, options, options);
  std::vector<std::string> executed;
  serve(world, executed, 50'000);
  struct Sum {
    std::vector<std::pair<std::int64_t, double>> sent;
    double all = 0;
  } sums[2];
  world.on_frame = [&](bool is_down, std::int64_t now_ns, const Buffer& frame) {
    Sum& sum = sums[is_down ? 1 : 0];
    sum.all += static_cast<double>(frame.size());
    sum.sent.emplace_back(now_ns, sum.all);
  };
  ASSERT_TRUE(world.connect());
  for (unsigned i = 0; i < 20; ++i) ASSERT_TRUE(world.host.request(text_of(i, 4000)));
  world.run(60);
  for (const Sum& sum : sums) {
    EXPECT_GT(sum.all, 40'000);
    for (std::size_t from = 1; from < sum.sent.size(); from += 7) {
      for (std::size_t to = from; to < sum.sent.size(); to += 3) {
        const double time_s = static_cast<double>(sum.sent[to].first - sum.sent[from].first) * 1e-9;
        ASSERT_LE(sum.sent[to].second - sum.sent[from - 1].second,
                  1500 * time_s + Budget::kBurst + Budget::kDebt + 1);
      }
    }
  }
}

TEST(LinkSession, ReportsComeTwiceASecondAndOnlyNewerOnes) {
  World world({.repeat = 0.3, .latency_s = 0.2, .jitter_s = 1.2}, 5);
  world.report.order_sequence = 0;
  ASSERT_TRUE(world.connect());
  std::vector<std::uint16_t> seen;
  ASSERT_FALSE(world.run(60, [&] {
    world.report.order_sequence = static_cast<std::uint16_t>(world.now_ns / 500'000'000);
    if (const auto report = world.host.take_report()) seen.push_back(report->report.order_sequence);
    return false;
  }));
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_GE(seen[i], seen[i - 1]);
  EXPECT_GT(seen.size(), 60U);
  EXPECT_LE(seen.size(), 122U);
}

TEST(LinkSession, ADeadLinkIsNoticedAndTheStreamGoesOnWhereItWas) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    World world({.loss = 0.1}, seed, World::with_key(kSecret), World::with_key(kSecret));
    std::vector<std::string> executed;
    serve(world, executed, 20'000);
    ASSERT_TRUE(world.connect());
    (void)world.vehicle.take_events();
    ASSERT_TRUE(world.host.request("before"));
    world.run(3);
    world.up.set_defects({.loss = 1});
    world.down.set_defects({.loss = 1});
    ASSERT_TRUE(world.run(10, [&] { return world.vehicle.peer() == Vehicle::Peer::dead; }));
    world.run(5);
    EXPECT_FALSE(world.host.is_alive(world.now_ns));
    ASSERT_TRUE(world.host.request("after"));
    const auto sent_before = world.up.bytes();
    world.run(60);
    EXPECT_LT(world.up.bytes() - sent_before, 60U * 200) << "little is sent into the void";
    world.up.set_defects({.loss = 0.1});
    world.down.set_defects({.loss = 0.1});
    std::vector<std::string> answers;
    ASSERT_TRUE(world.run(120, [&] {
      while (auto answer = world.host.take_response()) answers.push_back(answer->substr(0, 9));
      return answers.size() == 2;
    }));
    EXPECT_EQ(executed, (std::vector<std::string>{"before", "after"}));
    EXPECT_EQ(answers, (std::vector<std::string>{"re before", "re after."}));
    const auto events = world.vehicle.take_events();
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].kind, Vehicle::Event::Kind::silent);
    EXPECT_EQ(events[1].kind, Vehicle::Event::Kind::returned);
    EXPECT_EQ(events[1].session, 1U);
  }
}

TEST(LinkSession, ByeEndsASessionInGoodOrder) {
  World world({.loss = 0.3}, 8);
  ASSERT_TRUE(world.connect());
  world.host.bye();
  ASSERT_TRUE(world.run(5, [&] { return world.host.has_said_bye(); }));
  world.run(10);
  const auto events = world.vehicle.take_events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[1].kind, Vehicle::Event::Kind::left);
  EXPECT_EQ(world.vehicle.peer(), Vehicle::Peer::none);
  EXPECT_EQ(world.vehicle.session(), 1U) << "a goodbye begins no session";
  EXPECT_EQ(world.host.sessions(), 1U);
}

TEST(LinkSession, AVehicleThatWasStartedAnewGetsANewSessionAndExecutesNothingTwice) {
  World world({.latency_s = 0.1}, 9, World::with_key(kSecret), World::with_key(kSecret));
  std::vector<std::string> executed;
  serve(world, executed);
  ASSERT_TRUE(world.connect());
  ASSERT_TRUE(world.host.request("once"));
  ASSERT_TRUE(world.run(5, [&] { return !executed.empty(); }));
  world.vehicle = Vehicle(World::with_nonces(World::with_key(kSecret), 99));
  ASSERT_TRUE(world.run(20, [&] { return world.host.sessions() == 2; }));
  world.run(20);
  EXPECT_EQ(executed, std::vector<std::string>{"once"});
  ASSERT_TRUE(world.host.request("again"));
  ASSERT_TRUE(world.run(5, [&] { return executed.size() == 2; }));
}

TEST(LinkSession, AnotherOperatorWithTheKeyTakesOver) {
  World world({}, 10, World::with_key(kSecret), World::with_key(kSecret));
  ASSERT_TRUE(world.connect());
  world.host = Host(World::with_nonces(World::with_key(kSecret), 77));
  ASSERT_TRUE(world.run(20, [&] { return world.vehicle.session() == 2; }));
  const auto events = world.vehicle.take_events();
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[1].kind, Vehicle::Event::Kind::left);
  EXPECT_EQ(events[1].session, 1U);
  EXPECT_EQ(events[2].kind, Vehicle::Event::Kind::came);
}

TEST(LinkSession, WithoutTheRightKeyThereAreReportsAndAReasonButNoSession) {
  struct Case {
    EndOptions vehicle, host;
    Refusal why;
  };
  const Case cases[] = {{World::with_key(kSecret), {}, Refusal::untagged},
                        {World::with_key(kSecret), World::with_key("quite another secret"), Refusal::bad_tag},
                        {{}, World::with_key(kSecret), Refusal::no_key}};
  for (const Case& c : cases) {
    World world({}, 11, c.vehicle, c.host);
    unsigned reports = 0;
    Refusal why = Refusal::none;
    ASSERT_FALSE(world.run(20, [&] {
      if (const auto report = world.host.take_report()) {
        ++reports;
        EXPECT_FALSE(report->is_verified);
      }
      if (const auto refusal = world.host.take_refusal(); refusal != Refusal::none) why = refusal;
      return world.host.has_session();
    }));
    EXPECT_EQ(why, c.why);
    EXPECT_FALSE(words_for(why).empty());
    EXPECT_EQ(reports > 30, !c.host.key) << "an end with a key believes only what it can check";
    EXPECT_GT(world.vehicle.counters().refused, 0U);
    EXPECT_EQ(world.vehicle.session(), 0U);
  }
}

/// Frames that an attacker sends who has recorded everything and knows the format, but not the key.
TEST(LinkSession, RecordedAndForgedFramesChangeNothing) {
  World world({.latency_s = 0.05}, 12, World::with_key(kSecret), World::with_key(kSecret));
  std::vector<Buffer> recorded;
  world.on_frame = [&](bool is_down, std::int64_t, const Buffer& frame) {
    if (!is_down && recorded.size() < 400) recorded.push_back(frame);
  };
  std::vector<std::string> executed;
  std::vector<int> orders;
  serve(world, executed);
  const auto requests = world.work;
  world.work = [&] {
    requests();
    if (const auto command = world.vehicle.take_command()) {
      orders.push_back(static_cast<int>(command->shaft_rpm));
      world.vehicle.answer({command->number, true, false, ""});
    }
  };
  ASSERT_TRUE(world.connect());
  for (int i = 1; i <= 10; ++i) {
    Command order;
    order.kind = Command::Kind::order;
    order.shaft_rpm = i;
    (void)world.host.command(world.now_ns, order);
    ASSERT_TRUE(world.host.request(text_of(static_cast<unsigned>(i), 300)));
    world.run(1);
  }
  ASSERT_EQ(executed.size(), 10U);
  const auto orders_before = orders;
  std::minstd_rand random(5);
  const auto attacked = recorded;
  for (unsigned round = 0; round < 2000; ++round) {
    Buffer frame = attacked[random() % attacked.size()];
    const auto view = view_frame(frame);
    ASSERT_TRUE(view);
    switch (round % 4) {
      case 0: break;  // as it was
      case 1: {       // a higher counter, the old tag
        Header header = view->header;
        header.counter += 10'000 + round;
        const Buffer tag(view->tag.begin(), view->tag.end());
        frame = FrameWriter(header, view->payload).finish(tag);
        break;
      }
      case 2: {  // without a tag
        Header header = view->header;
        header.is_tagged = false;
        header.counter += 10'000 + round;
        frame = FrameWriter(header, view->payload).finish({});
        break;
      }
      default: {  // an order of the attacker's own
        Command order;
        order.kind = Command::Kind::order;
        order.number = static_cast<std::uint16_t>(random());
        order.shaft_rpm = 999;
        const Buffer tag(kTagLength, static_cast<std::uint8_t>(round));
        const Header header{FrameType::command, true, view->header.session, 50'000 + round};
        frame = FrameWriter(header, encode_command(order)).finish(tag);
      }
    }
    world.vehicle.take(world.now_ns, frame);
    world.run(0.02);
  }
  EXPECT_EQ(orders, orders_before);
  EXPECT_EQ(executed.size(), 10U);
  EXPECT_EQ(world.vehicle.session(), 1U);
  EXPECT_EQ(world.vehicle.peer(), Vehicle::Peer::alive);
  EXPECT_GT(world.vehicle.counters().repeated, 100U);
  EXPECT_GT(world.vehicle.counters().refused, 1000U);
  ASSERT_TRUE(world.host.request("still there"));
  ASSERT_TRUE(world.run(10, [&] { return executed.size() == 11; }));

  // The recording is of no use in a later session either.
  world.vehicle = Vehicle(World::with_nonces(World::with_key(kSecret), 55));
  for (const Buffer& frame : attacked) world.vehicle.take(world.now_ns, frame);
  EXPECT_FALSE(world.vehicle.take_command());
  EXPECT_FALSE(world.vehicle.take_request());
  EXPECT_EQ(world.vehicle.session(), 0U);
}

TEST(LinkSession, AForgedWelcomeOrRefusalDoesNotEndASession) {
  World world({}, 13, World::with_key(kSecret), World::with_key(kSecret));
  ASSERT_TRUE(world.connect());
  std::vector<Buffer> down;
  world.on_frame = [&](bool is_down, std::int64_t, const Buffer& frame) {
    if (is_down) down.push_back(frame);
  };
  for (unsigned i = 0; i < 50; ++i) {
    const auto session = view_frame(down.empty() ? Buffer(kMaxFrame) : down.back());
    const Header header{FrameType::refusal, false, session ? session->header.session : std::uint16_t{0}, i};
    const Buffer payload{static_cast<std::uint8_t>(Refusal::unknown_session)};
    world.host.take(world.now_ns, FrameWriter(header, payload).finish({}));
    world.host.take(world.now_ns, FrameWriter({FrameType::welcome, true, 7, 0}, Buffer(16)).finish(Buffer(8)));
    world.run(0.5);
  }
  EXPECT_TRUE(world.host.is_alive(world.now_ns));
  EXPECT_EQ(world.vehicle.peer(), Vehicle::Peer::alive);
  ASSERT_TRUE(world.host.request("x"));
  EXPECT_TRUE(world.run(5, [&] { return world.vehicle.take_request().has_value(); }));
}

TEST(LinkSession, AnOrderReplacesNoLeaseAndNoRelease) {
  World world({.latency_s = 1}, 14);
  ASSERT_FALSE(world.host.command(world.now_ns, {})) << "there is no session yet";
  ASSERT_TRUE(world.connect());
  Command order;
  order.kind = Command::Kind::order;
  ASSERT_TRUE(world.host.command(world.now_ns, order));
  ASSERT_TRUE(world.host.command(world.now_ns, {}));
  EXPECT_FALSE(world.host.command(world.now_ns, order));
  std::vector<Command::Kind> kinds;
  world.work = [&] {
    if (const auto command = world.vehicle.take_command()) {
      kinds.push_back(command->kind);
      world.vehicle.answer({command->number, false, false, "no such lease"});
    }
  };
  std::optional<CommandAnswer> answer;
  ASSERT_TRUE(world.run(10, [&] { return (answer = world.host.take_answer()).has_value(); }));
  EXPECT_EQ(answer->error, "no such lease");
  EXPECT_EQ(kinds, std::vector<Command::Kind>{Command::Kind::release});
  EXPECT_TRUE(world.host.command(world.now_ns, order));
}

}  // namespace
}  // namespace navcal::link
