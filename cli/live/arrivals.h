// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::cli {

/// A quantity that an owner expects of a port, and what to do when it does not arrive.
struct ExpectedQuantity {
  std::string role, todo;  ///< role: as of [roles] in the configuration
};

/// What one port of a running navcald delivers: lines of the status socket in (RECORD, HEALTH), text out. No I/O.
class Arrivals {
 public:
  /// Request for the lines that are needed.
  static constexpr std::string_view kRequest =
      "?WATCH={\"enable\":true,\"json\":true,\"classes\":[\"RECORD\",\"HEALTH\"]};\n";

  explicit Arrivals(std::string port) : port_(std::move(port)) {}

  /// Takes one line. Lines that are not understood, and those of other ports, are passed over.
  void take(std::string_view line);
  /// State of the port; for each kind of sample the rate over `seconds`, the mean standard error of its times and
  /// its mean age on arrival; the quantities that the port serves, and UTC.
  [[nodiscard]] std::string came() const;
  /// One line for each expected quantity that did not come, with what to do. `silent` is the advice for a port
  /// from which nothing comes at all. Empty: all came.
  [[nodiscard]] std::string missing(const std::vector<ExpectedQuantity>& expected,
                                    const std::string& silent) const;

 private:
  struct Count {
    int samples = 0;
    double first_s = 0, last_s = 0;    ///< arrivals
    double time_std_s = 0, age_s = 0;  ///< sums
  };

  std::string port_;
  std::map<std::string, Count> counts_;  ///< by class of the sample
  nlohmann::json health_;                ///< the newest with this port
  nlohmann::json state_;                 ///< of the port
};

}  // namespace navcal::cli
