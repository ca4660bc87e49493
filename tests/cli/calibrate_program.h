// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "tests/support/temporary_folder.h"

namespace navcal::cli::test {

/// `navcal simulate` and `navcal calibrate` as people run them, in a folder of their own.
class CalibrateProgram : public testing::Test {
 protected:
  /// Standard output; fails the test where the command fails.
  std::string output_of(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.path().string() + "' && '" NAVCAL_PROGRAM "' " + arguments + " > out 2> err < /dev/null";
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << arguments << '\n'
                                                               << navcal::test::read_file(folder_ / "err");
    return navcal::test::read_file(folder_ / "out");
  }
  nlohmann::json calibrated(const std::string& files) const {
    return nlohmann::json::parse(output_of("calibrate --json " + files), nullptr, false);
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  /// A path file of a hull at one place: angles in radians as a function of time, `duration_s` long.
  struct Angles {
    double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;
  };
  void write_path(const std::string& name, double duration_s, const std::function<Angles(double)>& at) const {
    constexpr double kStep_s = 0.05, kHalf_s = 1e-4;
    std::ofstream file(folder_ / name);
    file << "t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3\n";
    for (int i = 0; i * kStep_s <= duration_s; ++i) {
      const double t_s = i * kStep_s;
      const Angles a = at(t_s), before = at(t_s - kHalf_s), after = at(t_s + kHalf_s);
      const double roll = (after.roll_rad - before.roll_rad) / (2 * kHalf_s);
      const double pitch = (after.pitch_rad - before.pitch_rad) / (2 * kHalf_s);
      const double yaw = (after.yaw_rad - before.yaw_rad) / (2 * kHalf_s);
      const double sine = std::sin(a.roll_rad), cosine = std::cos(a.roll_rad);
      const double p = roll - yaw * std::sin(a.pitch_rad);
      const double q = pitch * cosine + yaw * std::cos(a.pitch_rad) * sine;
      const double r = -pitch * sine + yaw * std::cos(a.pitch_rad) * cosine;
      file << t_s << ",0,0,5," << a.roll_rad << ',' << a.pitch_rad << ',' << a.yaw_rad << ",0.5,0,0," << p << ','
           << q << ',' << r << ",700,0,0,0\n";
    }
  }

  navcal::test::TemporaryFolder folder_;
};

}  // namespace navcal::cli::test
