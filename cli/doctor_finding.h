// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace navcal::cli {

/// Result of one check of what can spoil the data.
struct Finding {
  enum class Severity : std::uint8_t { good, warning, fault };

  Severity severity = Severity::good;
  std::string topic;  ///< "port compass", "clock"
  std::string found;
  std::string mend;  ///< a command, or what to do; empty when all is well
};

using Findings = std::vector<Finding>;

inline Finding good(std::string topic, std::string found) {
  return {Finding::Severity::good, std::move(topic), std::move(found), {}};
}
inline Finding warning(std::string topic, std::string found, std::string mend) {
  return {Finding::Severity::warning, std::move(topic), std::move(found), std::move(mend)};
}
inline Finding fault(std::string topic, std::string found, std::string mend) {
  return {Finding::Severity::fault, std::move(topic), std::move(found), std::move(mend)};
}

}  // namespace navcal::cli
