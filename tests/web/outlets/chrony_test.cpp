// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/chrony.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <boost/asio/io_context.hpp>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>

namespace navcal::web {
namespace {

constexpr std::int64_t kS = 1'000'000'000;

// refclock_sock.c of chrony reads exactly these members.
static_assert(offsetof(ChronySample, offset) == sizeof(timeval) && sizeof(double) == 8);
static_assert(sizeof(ChronySample) == sizeof(timeval) + 8 + 4 * sizeof(int));

TEST(ChronySampling, TheOffsetIsThatOfTheTrueTimeFromTheSystemClock) {
  const ClockMapping mapping{true, 1'700'000'000 * kS, 100 * kS};
  const auto sample = chrony_sample(mapping, {101 * kS, 1'700'000'100 * kS + 750'000'000});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->tv.tv_sec, 1'700'000'100);
  EXPECT_EQ(sample->tv.tv_usec, 750'000);
  EXPECT_DOUBLE_EQ(sample->offset, 0.25);
  EXPECT_EQ(sample->magic, 0x534f434b);
  EXPECT_EQ(sample->pulse, 0);
  EXPECT_EQ(sample->leap, 0);
}

TEST(ChronySampling, OnlyAYoungMappingOfGpsCounts) {
  const ClockPair now{100 * kS, 1'700'000'000 * kS};
  EXPECT_TRUE(chrony_sample({true, 0, 100 * kS}, now));
  EXPECT_TRUE(chrony_sample({true, 0, 95 * kS}, now));
  EXPECT_FALSE(chrony_sample({true, 0, 94 * kS}, now)) << "chrony has slewed both clocks since";
  EXPECT_FALSE(chrony_sample({true, 0, 101 * kS}, now)) << "of another machine";
  EXPECT_FALSE(chrony_sample({false, 0, 100 * kS}, now)) << "the system's own time would come back to it";
}

TEST(ChronySampling, MappingsAreRead) {
  const auto mapping = read_mapping(R"({"source":"gps","offset":1700000000.250000000,"bound":0.02,"at":12.5})");
  ASSERT_TRUE(mapping);
  EXPECT_TRUE(mapping->is_gps);
  EXPECT_NEAR(static_cast<double>(mapping->offset_ns - 1'700'000'000 * kS), 250e6, 500);
  EXPECT_EQ(mapping->at_ns, 12 * kS + kS / 2);
  EXPECT_FALSE(read_mapping(R"({"source":"system","offset":1,"at":1})")->is_gps);
  for (const char* bad : {"", "7", "{}", R"({"source":"gps","offset":null,"at":1})", R"({"offset":1e300,"at":1})",
                          R"({"source":"gps","offset":1})"})
    EXPECT_FALSE(read_mapping(bad)) << bad;
}

TEST(ChronySampling, BothClocksAreReadTogether) {
  // A loop of readings: the difference of the clocks is constant but for the time between two readings.
  const ClockPair first = read_clocks();
  for (int i = 0; i < 100; ++i) {
    const ClockPair next = read_clocks();
    EXPECT_GE(next.monotonic_ns, first.monotonic_ns);
  }
}

TEST(ChronySampling, OneDatagramForEachMappingAndNobodyIsWaitedFor) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("navcal-chrony-" + std::to_string(::getpid()))).string();
  boost::asio::io_context context;
  Hub hub;
  Chrony chrony(context.get_executor(), path, hub);
  const auto say = [&](std::int64_t at_ns) {
    const std::string message = R"({"source":"gps","offset":1700000000,"at":)" + std::to_string(at_ns / kS) + "." +
                                std::to_string(kS + at_ns % kS).substr(1) + "}";
    hub.publish({"/time", "", std::nullopt, message});
  };
  say(read_clocks().monotonic_ns - kS / 2);
  EXPECT_EQ(chrony.counters().not_sent, 1U) << "chronyd is not there";

  const int receiver = ::socket(AF_UNIX, SOCK_DGRAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(receiver, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const std::int64_t at_ns = read_clocks().monotonic_ns - kS / 4;
  say(at_ns);
  say(at_ns);
  EXPECT_EQ(chrony.counters().samples, 1U) << "the same mapping again";
  ChronySample sample{};
  EXPECT_EQ(::recv(receiver, &sample, sizeof sample, MSG_DONTWAIT), static_cast<ssize_t>(sizeof sample));
  EXPECT_EQ(sample.magic, 0x534f434b);
  EXPECT_LT(::recv(receiver, &sample, sizeof sample, MSG_DONTWAIT), 0);
  // A receiver that does not read fills its queue; the sender goes on.
  for (int i = 1; i < 2000; ++i) say(at_ns + i * 1000);
  EXPECT_GT(chrony.counters().not_sent, 1U);
  ::close(receiver);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace navcal::web
