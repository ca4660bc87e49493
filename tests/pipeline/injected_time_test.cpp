// SPDX-License-Identifier: Apache-2.0
// Times of validity of injected samples.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/load.h"
#include "pipeline/pipeline.h"

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kInjectedSecond_ns = 1'000'000'000;
constexpr std::int64_t kInjectedOffset_ns = 1'700'000'000 * kInjectedSecond_ns;

struct InjectedTime : testing::Test, Sink {
  config::Settings settings = [] {
    config::Settings one;
    one.ports.push_back(config::default_port("injected", protocols::Protocol::samples, 4'000'000));
    return one;
  }();
  Pipeline pipeline{settings};
  std::vector<instruments::Sample> samples;
  std::vector<UtcMapping> mappings;

  void on_sample(const instruments::Sample& sample) override { samples.push_back(sample); }
  void on_mapping(const UtcMapping& mapping) override { mappings.push_back(mapping); }
  void map(UtcMapping::Source source) {
    pipeline.set_mapping({source, kInjectedOffset_ns, 0, 0}, *this);
    mappings.clear();
  }
  void send(std::int64_t arrival_ns, const std::string& line) {
    const std::string text = line + "\n";
    pipeline.bytes(0, arrival_ns, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, *this);
  }
};

TEST_F(InjectedTime, TheSendersUtcPlacesASampleToTheNanosecond) {
  map(UtcMapping::Source::gps);
  send(100 * kInjectedSecond_ns,
       R"({"class":"DEPTH","depth_m":3,"time":1700000099.123456789,"time_std":0.000250001})");
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].stamp.validity_ns, 99'123'456'789);
  EXPECT_EQ(samples[0].stamp.validity_utc_ns, 1'700'000'099'123'456'789);
  EXPECT_EQ(samples[0].stamp.arrival_ns, 100 * kInjectedSecond_ns);
  EXPECT_EQ(samples[0].stamp.std_ns, 250'001);
}

TEST_F(InjectedTime, WithoutATimeTheArrivalCounts) {
  map(UtcMapping::Source::gps);
  send(100 * kInjectedSecond_ns, R"({"class":"DEPTH","depth_m":3})");
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_NEAR(static_cast<double>(samples[0].stamp.validity_ns), 100e9, 1e6) << "less the time on a quick line";
  EXPECT_EQ(samples[0].stamp.std_ns, 10'000'000) << "latency_std_ms of the port";
}

TEST_F(InjectedTime, WithoutAMappingTheArrivalCounts) {
  send(100 * kInjectedSecond_ns, R"({"class":"DEPTH","depth_m":3,"time":1700000050})");
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_NEAR(static_cast<double>(samples[0].stamp.validity_ns), 100e9, 1e6);
  EXPECT_EQ(samples[0].stamp.validity_utc_ns, 1'700'000'050 * kInjectedSecond_ns) << "as the sender says";
}

TEST_F(InjectedTime, ItDefinesNoMapping) {
  for (int i = 0; i < 50; ++i)
    send((100 + i) * kInjectedSecond_ns,
         R"({"class":"GPS","lat":1,"lon":2,"fix":"3d","time":)" + std::to_string(1'600'000'000 + i) + "}");
  EXPECT_EQ(samples.size(), 50U);
  EXPECT_TRUE(mappings.empty());
  EXPECT_EQ(pipeline.mapping().source, UtcMapping::Source::none);
  map(UtcMapping::Source::system);
  send(200 * kInjectedSecond_ns, R"({"class":"GPS","lat":1,"lon":2,"fix":"3d","time":1700000199})");
  EXPECT_TRUE(mappings.empty());
}

TEST_F(InjectedTime, ASampleOfTheFutureIsCounted) {
  map(UtcMapping::Source::gps);
  send(100 * kInjectedSecond_ns, R"({"class":"DEPTH","depth_m":3,"time":1700000100.9})");
  EXPECT_EQ(samples.size(), 1U) << "clocks differ a little";
  send(101 * kInjectedSecond_ns, R"({"class":"DEPTH","depth_m":3,"time":1700000200})");
  EXPECT_EQ(samples.size(), 1U);
  EXPECT_EQ(pipeline.statistics(0).out_of_range, 1U);
  send(102 * kInjectedSecond_ns, R"({"class":"DEPTH","depth_m":3,"time":1700000040})");
  EXPECT_EQ(samples.size(), 2U) << "an acoustic position may be late";
}

}  // namespace
}  // namespace navcal::pipeline
