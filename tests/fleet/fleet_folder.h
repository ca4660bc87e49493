// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "fleet/make_plan.h"
#include "tests/support/temporary_folder.h"

namespace navcal::fleet::test {

/// A folder with recordings and a plan of them, in files that are read in a millisecond.
class FleetFolder {
 public:
  /// A capture of `reads` reads, which `content` tells from others.
  std::filesystem::path add_recording(const std::string& name, int content, int reads = 3) const {
    std::string text = "#capture 1\n#port imu imu-card 57600\n";
    for (int i = 0; i < reads; ++i) {
      text += "170000000" + std::to_string(i) + ".000000000 imu < " + std::to_string(1000 + content) + "\n";
    }
    return add_file(name, text);
  }
  std::filesystem::path add_file(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = recordings() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  [[nodiscard]] PlanRequest request(std::vector<std::string> jobs = {"calibrate"}) const {
    PlanRequest request;
    request.recordings = recordings();
    request.plan = plan();
    request.jobs = std::move(jobs);
    return request;
  }
  PlanSummary make(std::vector<std::string> jobs = {"calibrate"}) const {
    return make_plan(request(std::move(jobs)), [](std::string_view, double) {});
  }
  [[nodiscard]] std::filesystem::path recordings() const { return folder_ / "recordings"; }
  [[nodiscard]] std::filesystem::path plan() const { return folder_ / "plan"; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  navcal::test::TemporaryFolder folder_;
};

}  // namespace navcal::fleet::test
