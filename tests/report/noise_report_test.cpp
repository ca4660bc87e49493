// SPDX-License-Identifier: Apache-2.0
#include "report/noise_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/analysis/noise/made_noise.h"
#include "tests/report/markup.h"

namespace navcal::report {
namespace {

using analysis::RecordedChannel;

RecordedChannel made_channel(std::size_t row, std::vector<double> values,
                             const std::vector<analysis::Interval>& quiet) {
  const auto& of = analysis::noise_channels()[row];
  RecordedChannel channel{"imu",
                          std::string(of.name),
                          std::string(of.unit),
                          &of,
                          analysis::noise_test::series_of(std::move(values), 0.05),
                          {}};
  channel.noise = analysis::channel_noise(channel.series, quiet);
  return channel;
}

/// Rows 8 to 10 of the table are rates.
analysis::NoiseReport made_report() {
  analysis::noise_test::MadeNoise noise(1);
  analysis::NoiseReport report;
  report.file = "a <b> & \"c\".cap";
  report.duration_s = 200;
  report.quiet = {{0, 80}, {120, 200}};
  report.channels.push_back(made_channel(8, noise.white(4000, 0.1), report.quiet));
  report.channels.push_back(made_channel(
      9, analysis::noise_test::sum(noise.white(4000, 0.1), analysis::noise_test::sine(4000, 0.2, 0.25)),
      report.quiet));
  report.channels.push_back(made_channel(10, std::vector<double>(4000, 2.5), report.quiet));
  report.channels.push_back(made_channel(11, noise.walk(4000, 0.1), report.quiet));
  return report;
}

TEST(NoiseReport, ThePageIsWellFormedAndHoldsEachChannel) {
  const std::string page = noise_page(made_report());
  EXPECT_EQ(cli::test::flaw_in(page), "");
  for (const char* const text :
       {"imu.rate_x", "imu.rate_y", "imu.rate_z", "Allan deviation", "Spectrum", "at rest", "random walk, +1/2",
        "white, -1/2", "constant: noise below the resolution"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

TEST(NoiseReport, PagesOfNothingAreWellFormedToo) {
  analysis::NoiseReport report;
  report.file = "x.cap";
  EXPECT_EQ(cli::test::flaw_in(noise_page(report)), "");
  report = made_report();
  report.quiet.clear();
  for (auto& channel : report.channels) channel.noise = {};
  report.quietest = analysis::QuietestWindow{12, "imu.rate_x", "deg/s", "varies by", 0.8, 0.05};
  EXPECT_EQ(cli::test::flaw_in(noise_page(report)), "");
  EXPECT_NE(noise_text(report).find("imu.rate_x varies by 0.8 deg/s; rest is below 0.05 deg/s"), std::string::npos)
      << noise_text(report);
}

TEST(NoiseReport, TheJsonHasItsKeys) {
  const auto json = nlohmann::json::parse(noise_json(made_report()));
  EXPECT_EQ(json["class"], "NOISE");
  EXPECT_EQ(json["quiet"][1]["from_s"], 120);
  EXPECT_EQ(json["reason"], nullptr);
  const auto& channel = json["channels"][0];
  for (const char* const key : {"device",
                                "channel",
                                "unit",
                                "readings",
                                "stretches",
                                "seconds",
                                "rate_Hz",
                                "mean",
                                "scatter",
                                "resolution",
                                "constant",
                                "std",
                                "std_error",
                                "rounding_std",
                                "unrounded_std",
                                "unrounded_std_error",
                                "drifts",
                                "correlated",
                                "correlation",
                                "time_constant_s",
                                "effective_std",
                                "effective_std_error",
                                "white_noise",
                                "white_noise_error",
                                "white_noise_limit",
                                "white_noise_needs_s",
                                "bias_instability",
                                "bias_instability_error",
                                "bias_instability_limit",
                                "bias_instability_needs_s",
                                "random_walk",
                                "random_walk_error",
                                "random_walk_limit",
                                "random_walk_needs_s",
                                "allan",
                                "spectrum",
                                "lines",
                                "remarks"})
    EXPECT_TRUE(channel.contains(key)) << key;
  EXPECT_EQ(channel["stretches"], 2);
  EXPECT_NEAR(channel["std"], 0.1, 0.006);
  EXPECT_EQ(channel["spectrum"]["density"].size(), channel["spectrum"]["frequency_Hz"].size());
  EXPECT_NEAR(json["channels"][1]["lines"][0]["frequency_Hz"], 5, 0.05);
  EXPECT_EQ(json["channels"][2]["constant"], true);
  EXPECT_EQ(json["channels"][2]["std"], nullptr);
  EXPECT_EQ(json["channels"][3]["drifts"], true);
}

TEST(NoiseReport, RemarksSayWhatTheTableDoesNot) {
  const auto report = made_report();
  const auto text = noise_text(report);
  for (const char* const words : {"at rest: 0 to 80 s, 120 to 200 s (2 min 40 s)", "2 stretches without a gap",
                                  "line at 5 Hz, amplitude 0.2 deg/s", "needs at least", "the readings drift"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

}  // namespace
}  // namespace navcal::report
