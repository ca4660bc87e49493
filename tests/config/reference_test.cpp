// SPDX-License-Identifier: Apache-2.0
// The shipped file and the page in docs/ say what the program does.
#include "config/reference.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "config/load.h"
#include "config/mission_limits.h"
#include "config/mission_options.h"
#include "config/options.h"
#include "config/vehicle_file.h"

namespace navcal::config {
namespace {

std::string content(const std::string& file) {
  std::ostringstream out;
  out << std::ifstream(std::string(NAVCAL_SOURCE_DIR) + "/" + file).rdbuf();
  return out.str();
}

constexpr const char* kRemedy = "run: cmake --build DIR --target config-reference";

TEST(ConfigReference, TheShippedFileIsWrittenFromTheOptionTable) {
  EXPECT_EQ(content("config/navcald.toml"), shipped_file()) << kRemedy;
}

TEST(ConfigReference, TheTablesOfThePageAreWrittenFromTheOptionTable) {
  const std::string page = content("docs/configuration.md");
  EXPECT_NE(page.find("### `[log]`"), std::string::npos) << kRemedy;
  EXPECT_EQ(page, with_option_tables(page)) << kRemedy;
}

TEST(ConfigReference, TheShippedFileStatesTheDefaultsAndTheVehicle) {
  const Settings shipped = load(std::string(NAVCAL_SOURCE_DIR) + "/config/navcald.toml");
  EXPECT_EQ(shipped, shipped_settings());
  EXPECT_EQ(shipped.log, LogSettings{});
  EXPECT_EQ(shipped.status, StatusSettings{});
  EXPECT_EQ(shipped.control, ControlSettings{});
  EXPECT_EQ(shipped.environment, EnvironmentSettings{});
  ASSERT_EQ(shipped.ports.size(), 4U);
  const auto& compass = shipped.ports[0];
  EXPECT_EQ(compass.name, "compass");
  EXPECT_EQ(compass.baud, 38400);
  EXPECT_EQ(compass.latency_s, 0.050);
  EXPECT_EQ(compass.rate_Hz, 10);
  const auto& imu = shipped.ports[1];
  EXPECT_EQ(imu.baud, 57600);
  EXPECT_EQ(imu.latency_s, 0.025);
  EXPECT_EQ(imu.rate_Hz, 20);
  EXPECT_EQ(imu.imu_card, ImuCardSettings{});
  EXPECT_EQ(shipped.ports[2].latency_s, 0.300);
  EXPECT_EQ(shipped.ports[3].latency_s, 0.005);
}

TEST(ConfigReference, DefaultsAreWithinTheirOwnRanges) {
  for (const auto& option : daemon_options()) {
    Value value = option.get(Settings{});
    EXPECT_EQ(option.adopt(value), std::nullopt) << option.name();
  }
  for (const auto& port : shipped_settings().ports) {
    for (const auto& option : port_options()) {
      Value value = option.get(port);
      const bool given = value != Value(std::string());  // two of the three places are not
      EXPECT_TRUE(!given || !option.adopt(value)) << option.name();
    }
  }
}

TEST(ConfigReference, EveryTextIsOfAnOption) {
  std::set<std::string, std::less<>> names;
  const auto add = [&](const auto& options, const std::string& untitled) {
    for (const auto& option : options) {
      const std::string table = option.table.empty() ? untitled : std::string(option.table);
      names.insert(table);
      names.insert(table + "." + std::string(option.key));
    }
  };
  add(daemon_options(), "");
  add(port_options(), "port");
  add(power_options(), "power");
  add(vehicle_options(), "");
  add(mission_options(), "");
  add(mission_limit_options(), "");
  add(step_options(), "step");
  std::ifstream file(std::string(NAVCAL_SOURCE_DIR) + "/config/option_texts.txt");
  std::set<std::string> seen;
  for (std::string row; std::getline(file, row);) {
    if (row.starts_with('#')) continue;
    const std::string name = row.substr(0, row.find(' '));
    EXPECT_TRUE(names.contains(name)) << row;
    EXPECT_TRUE(seen.insert(name).second) << row;
  }
  EXPECT_GT(seen.size(), 200U);
  EXPECT_THROW((void)option_text("log", "no_such_key"), std::out_of_range);
}

TEST(ConfigReference, EveryOptionIsDescribedOnce) {
  std::set<std::string> names;
  const auto check = [&names](const OptionInfo& option) {
    EXPECT_TRUE(names.insert(option.name()).second) << option.name();
    EXPECT_TRUE(option.description.ends_with('.') || option.description.ends_with(").")) << option.name();
    EXPECT_FALSE(option.allowed().empty()) << option.name();
    EXPECT_NO_THROW((void)option_text(option.table.empty() ? "port" : option.table)) << option.table;
  };
  for (const auto& option : daemon_options()) check(option);
  names.clear();
  for (const auto& option : port_options()) check(option);
}

TEST(ConfigReference, AnOptionSetsWhatItGets) {
  // At the ends of its range too, where a narrow member would wrap.
  for (const auto& option : daemon_options()) {
    if (option.kind != Kind::real && option.kind != Kind::integer) continue;
    for (const double number : {option.low, option.high}) {
      Settings settings;
      const Value value = option.kind == Kind::real ? Value(number) : Value(static_cast<std::int64_t>(number));
      option.set(settings, value);
      EXPECT_EQ(option.get(settings), value) << option.name();
    }
  }
}

}  // namespace
}  // namespace navcal::config
