// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace navcal::test {

/// Lines of text that are kept in fixtures/: answers of the program, which must stay as they were unless they are
/// meant to change.
class GoldenLines {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> text, Args&&... args) {
    lines_.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  /// Compares with fixtures/NAME.txt. Numbers may differ by 1 % and by 0.002: compilers round in their own ways.
  /// Lines that differ are written into the folder for temporary files as they are now.
  void expect_same_as(const std::string& name) const {
    const auto file = std::filesystem::path(NAVCAL_SOURCE_DIR) / "fixtures" / (name + ".txt");
    std::ifstream in(file);
    std::vector<std::string> wanted;
    for (std::string line; std::getline(in, line);) wanted.push_back(line);
    bool same = lines_.size() == wanted.size();
    for (std::size_t i = 0; i < std::min(lines_.size(), wanted.size()); ++i) {
      if (is_same(lines_[i], wanted[i])) continue;
      same = false;
      ADD_FAILURE() << file << ", line " << i + 1 << "\nis  " << lines_[i] << "\nwas " << wanted[i];
      break;
    }
    if (same) return;
    const auto now = std::filesystem::temp_directory_path() / "golden" / (name + ".txt");
    std::filesystem::create_directories(now.parent_path());
    std::ofstream(now) << fmt::format("{}\n", fmt::join(lines_, "\n"));
    FAIL() << lines_.size() << " lines, were " << wanted.size() << "; as it is now: " << now;
  }

 private:
  static bool is_same(const std::string& found, const std::string& wanted) {
    static const std::regex number(R"([-+]?\d+(\.\d+)?([eE][-+]?\d+)?)");
    if (std::regex_replace(found, number, "#") != std::regex_replace(wanted, number, "#")) return false;
    auto mine = std::sregex_iterator(found.begin(), found.end(), number);
    auto theirs = std::sregex_iterator(wanted.begin(), wanted.end(), number);
    for (; mine != std::sregex_iterator(); ++mine, ++theirs) {
      const double a = std::stod(mine->str()), b = std::stod(theirs->str());
      if (std::abs(a - b) > 0.01 * std::abs(b) + 0.002) return false;
    }
    return true;
  }

  std::vector<std::string> lines_;
};

}  // namespace navcal::test
