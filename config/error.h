// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace navcal::config {

/// All problems of a file of settings at once. what() has one line for each problem:
/// "navcald.toml:14: log.sync_intervall_s: unknown key; did you mean sync_interval_s?"
class Error : public std::runtime_error {
 public:
  explicit Error(std::vector<std::string> problems);
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

}  // namespace navcal::config
