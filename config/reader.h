// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/document.h"
#include "config/settings.h"

namespace navcal::config {

/// Turns entries into settings by the option table, and notes what is wrong with them.
class Reader {
 public:
  /// `folder` is where relative paths of descriptions begin; nullopt: no file may be read.
  explicit Reader(std::optional<std::filesystem::path> folder = std::nullopt) : folder_(std::move(folder)) {}

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
  /// Reads the description of a described device, and takes what it says of the port.
  void take_description(PortSettings& port, const std::vector<const Entry*>& entries);
  void take_port_entry(PortSettings& port, const Entry& entry, bool protocol_known);
  void take_power(const std::string& name, const std::vector<const Entry*>& entries);
  void complain(const Entry& entry, std::string message);
  /// The entries of the tables [kind.NAME], by name in the order of the file.
  using NamedTables = std::vector<std::pair<std::string, std::vector<const Entry*>>>;
  void collect(NamedTables& tables, const Entry& entry);

  std::optional<std::filesystem::path> folder_;
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
