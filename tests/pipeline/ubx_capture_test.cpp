// SPDX-License-Identifier: Apache-2.0
// Captures of u-blox receivers by others, through the pipeline of a port: whole, cut, and damaged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "config/load.h"
#include "pipeline/pipeline.h"
#include "tests/protocols/shared_capture.h"

namespace navcal::pipeline {
namespace {

using protocols::test::Buffer;
using protocols::test::shared_capture;

constexpr const char* kCaptures[] = {"MIXED",   "MIXED2", "MIXED3BADCK", "BADCK2", "BADEOF1",       "BADEOF2",
                                     "BADEOF3", "BADHDR", "NAV",         "MON",    "SF-calibration"};

/// One u-blox port that keeps its positions.
struct UbxPort : Sink {
  Pipeline pipeline{[] {
    config::Settings settings;
    settings.ports.push_back(config::default_port("gps", protocols::Protocol::ubx, 38400));
    return settings;
  }()};
  std::vector<instruments::GpsSample> fixes;

  /// Reads of at most 64 bytes at the pace of the line.
  explicit UbxPort(protocols::Bytes stream) {
    std::int64_t now_ns = 1'000'000'000;
    for (std::size_t at = 0; at < stream.size(); at += 64) {
      const auto piece = stream.subspan(at, std::min<std::size_t>(64, stream.size() - at));
      now_ns += static_cast<std::int64_t>(piece.size()) * 260'000;
      pipeline.bytes(0, now_ns, piece, *this);
    }
  }
  void on_sample(const instruments::Sample& sample) override {
    if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value)) fixes.push_back(*gps);
  }
  [[nodiscard]] bool accounts_for(std::size_t bytes) const {
    const PortStatistics statistics = pipeline.statistics(0);
    return statistics.bytes.bytes == bytes &&
           statistics.bytes.framed_bytes + statistics.bytes.skipped_bytes + statistics.held_bytes == bytes;
  }
};

TEST(UbxCaptures, EveryByteIsAccountedForAndValuesArePlausible) {
  for (const char* name : kCaptures) {
    const Buffer stream = shared_capture(std::string("ubx/pygpsdata-") + name + ".log");
    if (stream.empty()) GTEST_SKIP() << "no captures of u-blox receivers here";
    const UbxPort port(stream);
    EXPECT_TRUE(port.accounts_for(stream.size())) << name;
    EXPECT_EQ(port.pipeline.statistics(0).out_of_range, 0U) << name;
    for (const auto& fix : port.fixes) {
      if (!fix.latitude_rad) continue;
      EXPECT_LT(std::abs(*fix.height_m), 1000) << name;
      EXPECT_LT(*fix.speed_m_s, 50) << name;
      EXPECT_GT(*fix.position_std_m, 0) << name;
      EXPECT_LT(*fix.position_std_m, 100) << name;
      EXPECT_GT(fix.time_utc_ns.value_or(0), 1'577'836'800'000'000'000) << "2020 and later: " << name;
    }
  }
  const UbxPort mixed(shared_capture("ubx/pygpsdata-MIXED.log"));
  EXPECT_EQ(mixed.fixes.size(), 39U);
}

TEST(UbxCaptures, CutAfterEveryByteNothingIsLostThatWasWhole) {
  const Buffer stream = shared_capture("ubx/pygpsdata-MIXED.log");
  if (stream.empty()) GTEST_SKIP() << "no captures of u-blox receivers here";
  std::size_t before = 0;
  for (std::size_t cut = 0; cut < 4000; ++cut) {
    const UbxPort port(protocols::Bytes(stream).first(cut));
    ASSERT_TRUE(port.accounts_for(cut)) << cut;
    ASSERT_GE(port.fixes.size(), before) << cut;
    before = port.fixes.size();
  }
  EXPECT_GE(before, 3U);
}

/// No damage of one bit makes a position that was not sent.
TEST(UbxCaptures, AFlippedBitNeverGivesAnotherPosition) {
  const Buffer whole = shared_capture("ubx/pygpsdata-MIXED.log");
  if (whole.empty()) GTEST_SKIP() << "no captures of u-blox receivers here";
  const Buffer stream(whole.begin(), whole.begin() + 1500);
  std::set<double> sent;
  for (const auto& fix : UbxPort(stream).fixes) sent.insert(fix.latitude_rad.value_or(0));
  ASSERT_FALSE(sent.empty());
  for (std::size_t bit = 0; bit < 8 * stream.size(); ++bit) {
    Buffer damaged = stream;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    const UbxPort port(damaged);
    ASSERT_TRUE(port.accounts_for(damaged.size())) << bit;
    for (const auto& fix : port.fixes) ASSERT_TRUE(sent.count(fix.latitude_rad.value_or(0)) == 1) << bit;
  }
}

}  // namespace
}  // namespace navcal::pipeline
