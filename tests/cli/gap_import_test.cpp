// SPDX-License-Identifier: Apache-2.0
// A diagnosis of imported logs: one that has all it needs gives the answer of the original recording; one that
// does not have it says what is missing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

/// Columns of `navcal log export --csv` and what they mean, table by table.
struct ExportedTable {
  const char* file;
  std::vector<std::pair<std::string, std::string>> columns;
};
const std::array<ExportedTable, 4> kTables{
    ExportedTable{"compass",
                  {{"heading_rad", "heading"},
                   {"pitch_rad", "pitch"},
                   {"roll_rad", "roll"},
                   {"field_body_uT_x", "field_x"},
                   {"field_body_uT_y", "field_y"},
                   {"field_body_uT_z", "field_z"},
                   {"temperature_C", "compass_temperature"}}},
    ExportedTable{"imu",
                  {{"rate_rad_s_x", "rate_x"},
                   {"rate_rad_s_y", "rate_y"},
                   {"rate_rad_s_z", "rate_z"},
                   {"yaw_rate_b_rad_s", "rate_yaw_b"},
                   {"specific_force_m_s2_x", "force_x"},
                   {"specific_force_m_s2_y", "force_y"},
                   {"specific_force_m_s2_z", "force_z"},
                   {"depth_m", "imu_depth"}}},
    ExportedTable{"gps",
                  {{"lat_deg", "lat"}, {"lon_deg", "lon"}, {"speed_m_s", "speed"}, {"course_rad", "course"}}},
    ExportedTable{"motor",
                  {{"rpm", "rpm"},
                   {"rpm_commanded", "rpm_commanded"},
                   {"fins_rad_1", "fin_1"},
                   {"fins_rad_2", "fin_2"},
                   {"fins_rad_3", "fin_3"},
                   {"current_A", "motor_current"}}}};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream rest(line);
  for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
  return cells;
}

class GapImport : public testing::Test {
 protected:
  /// Exit status; what the program wrote is in the files "out" and "errors".
  [[nodiscard]] int status_of(const std::string& arguments) const {
    const std::string command = NAVCAL_PROGRAM " " + arguments + " >" + at("out") + " 2>" + at("errors");
    return std::system(command.c_str());
  }
  void run(const std::string& arguments) const {
    ASSERT_EQ(status_of(arguments), 0) << navcal::test::read_file(at("errors"));
  }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
  /// The exported tables as one: all columns, a row for each sample, in the order of time. No value is resampled.
  void join(const std::string& from, const std::string& to) const {
    std::vector<std::string> names;
    for (const ExportedTable& table : kTables) {
      for (const auto& [name, meaning] : table.columns) names.push_back(name);
    }
    std::multimap<std::string, std::string> rows;
    std::size_t before = 0;
    for (const ExportedTable& table : kTables) {
      std::ifstream lines(at(from) + "/" + table.file + ".csv");
      std::string line;
      std::getline(lines, line);
      const auto header = cells_of(line);
      while (std::getline(lines, line)) {
        auto cells = cells_of(line);
        cells.resize(header.size());
        std::string row(before, ',');
        for (const auto& [name, meaning] : table.columns) {
          const auto found = std::find(header.begin(), header.end(), name);
          ASSERT_NE(found, header.end()) << name;
          row += ',' + cells[static_cast<std::size_t>(found - header.begin())];
        }
        row.append(names.size() - before - table.columns.size(), ',');
        rows.emplace(cells[0], row);
      }
      before += table.columns.size();
    }
    std::ofstream file(at(to));
    file << fmt::format("time_s,{}\n", fmt::join(names, ","));
    for (const auto& [time, row] : rows) file << time << row << '\n';
  }
  [[nodiscard]] std::string map() const {
    std::string text = "[time]\ncolumn = \"time_s\"\nformat = \"unix_s\"\n";
    for (const ExportedTable& table : kTables) {
      for (const auto& [name, meaning] : table.columns)
        text += fmt::format("[column.{}]\nmeaning = \"{}\"\n", name, meaning);
    }
    return text;
  }
  [[nodiscard]] nlohmann::json gap(const std::string& mission, const std::string& holdout) const {
    run(fmt::format("gap --field 19,0.6,44 --bank 20 --cache {} --json {} --holdout {} {}",
                    folder_.path().string(), at("a.json"), at(holdout), at(mission)));
    return nlohmann::json::parse(navcal::test::read_file(at("a.json")));
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(GapImport, ARecordingThatWentThroughCsvHasTheAnswerOfTheOriginal) {
  std::ofstream(at("effects.toml")) << "[thrust_scale]\nscale = 0.16\n";
  std::ofstream(at("map.toml")) << map();
  for (const std::string name : {"a", "b"}) {
    run(fmt::format("simulate --mission identification --seconds 250 --seed {} --effects {} -o {}",
                    name == "a" ? 3 : 4, at("effects.toml"), at(name + ".cap")));
    run(fmt::format("log import -o {} {}", at(name + ".mcap"), at(name + ".cap")));
    run(fmt::format("log export --csv {} {}", at(name), at(name + ".mcap")));
    join(name, name + ".csv");
    run(fmt::format("log import --map {} -o {} {}", at("map.toml"), at(name + "_back.mcap"), at(name + ".csv")));
  }
  const auto original = gap("a.cap", "b.cap");
  const auto imported = gap("a_back.mcap", "b_back.mcap");
  EXPECT_EQ(original["verdict"], "explained") << original["sentence"];
  EXPECT_EQ(imported["verdict"], "explained") << imported["sentence"];
  ASSERT_EQ(original["effects"].size(), 1U);
  ASSERT_EQ(imported["effects"].size(), 1U) << imported["sentence"];
  EXPECT_EQ(imported["effects"][0]["name"], "thrust_scale");
  const auto number = [](const nlohmann::json& answer, const char* what) {
    return answer["effects"][0][what]["scale"].get<double>();
  };
  const double std = number(original, "std_errors");
  EXPECT_NEAR(number(imported, "parameters"), number(original, "parameters"), std)
      << "the times at which commands were sent are lost, and nothing else";
  EXPECT_NEAR(number(imported, "std_errors"), std, std / 2);
}

TEST_F(GapImport, ARecordingOfAnAutopilotIsToldWhatItLacks) {
  std::ofstream csv(at("log.csv"));
  csv << "t,gx,gy,gz,ax,ay,az,mx,my,mz,depth,throttle,rudder\n";
  for (int i = 0; i < 1000; ++i)
    csv << fmt::format("{:.1f},0,0,0,0,0,-9.81,19,0.6,44,{:.2f},{},1500\n", i * 0.1, 1 + i * 1e-3, 1500 + i % 100);
  csv.close();
  std::string text = "[time]\ncolumn = \"t\"\nformat = \"s\"\n";
  for (const auto& [name, meaning] : std::vector<std::pair<std::string, std::string>>{{"gx", "rate_x"},
                                                                                      {"gy", "rate_y"},
                                                                                      {"gz", "rate_z"},
                                                                                      {"ax", "force_x"},
                                                                                      {"ay", "force_y"},
                                                                                      {"az", "force_z"},
                                                                                      {"mx", "field_x"},
                                                                                      {"my", "field_y"},
                                                                                      {"mz", "field_z"},
                                                                                      {"depth", "depth"}})
    text += fmt::format("[column.{}]\nmeaning = \"{}\"\n", name, meaning);
  text += "[column.throttle]\nmeaning = \"rpm_commanded\"\nfrom = [1100, 1900]\nto = [-1200, 1200]\n";
  text += "[column.rudder]\nmeaning = \"fin_1\"\nunit = \"deg\"\nfrom = [1100, 1900]\nto = [-20, 20]\n";
  std::ofstream(at("map.toml")) << text;
  run(fmt::format("log import --map {} -o {} {}", at("map.toml"), at("log.mcap"), at("log.csv")));
  ASSERT_EQ(status_of(fmt::format("gap --json {} {}", at("a.json"), at("log.mcap"))), 0);
  const auto answer = nlohmann::json::parse(navcal::test::read_file(at("a.json")));
  EXPECT_EQ(answer["effects"].size(), 0U);
  EXPECT_NE(answer["verdict"], "no-gap");
  const std::string remarks = answer["remarks"].dump();
  EXPECT_NE(remarks.find("log.mcap: the motor card reports no shaft speed (rpm), current, fin angles: what the "
                         "vehicle was told to do is not known"),
            std::string::npos)
      << remarks;
}

}  // namespace
}  // namespace navcal::cli
