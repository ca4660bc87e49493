// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "config/document.h"
#include "config/settings.h"

namespace navcal::config {

/// Turns entries into settings by the option table, and notes what is wrong with them.
class Reader {
 public:
  /// Takes entries: first those of the file in its order, then those of the command line.
  void take(const std::vector<Entry>& entries);
  /// Checks that involve several settings: no ports, and places that are missing, ambiguous or shared.
  void check_ports();
  /// Reports roles given to ports that are missing or cannot deliver them.
  void check_roles();
  /// Reports a moved key beside the one that replaces it, and a longest time shorter than the shortest.
  void check_instruments(const std::vector<Entry>& entries);
  /// Reports limits of orders that contradict each other.
  void check_command();
  /// Reports ports that do not exist in [log] leave_out.
  void check_log();
  /// Reports supplies that are incomplete, share a line or a device, or feed no port.
  void check_power();
  /// Reports a remote link with two lines.
  void check_remote();

  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] std::vector<Problem>& problems() { return problems_; }

 private:
  void take_daemon(const Entry& entry);
  void take_port(const std::string& name, const std::vector<const Entry*>& entries);
  void take_port_entry(PortSettings& port, const Entry& entry, bool protocol_known);
  void take_power(const std::string& name, const std::vector<const Entry*>& entries);
  void complain(const Entry& entry, std::string message);
  /// The entries of the tables [kind.NAME], by name in the order of the file.
  using NamedTables = std::vector<std::pair<std::string, std::vector<const Entry*>>>;
  void collect(NamedTables& tables, const Entry& entry);

  Settings settings_;
  std::vector<unsigned> port_lines_;                  ///< where each port's table begins
  std::vector<unsigned> power_lines_;                 ///< likewise each supply's
  unsigned leave_out_line_ = 0;                       ///< where log.leave_out was given last
  std::array<unsigned, kRoles.size()> role_lines_{};  ///< where each role was given last; 0: the command line
  std::map<std::string, unsigned, std::less<>> command_lines_;  ///< where each key of [command] was given last
  unsigned remote_line_ = 1;                                    ///< of the last key of [remote]
  std::vector<Problem> problems_;
};

}  // namespace navcal::config
