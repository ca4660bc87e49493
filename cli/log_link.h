// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/line_socket.h"

namespace navcal::cli {

/// A log in the folder of a running navcald.
struct RemoteLog {
  std::string name;
  std::uint64_t bytes = 0;
  bool finished = false;
  std::string begin, end;  ///< UTC as the daemon writes it; empty: not known
};

/// The log commands of navcald's control socket. Every function throws analysis::Failure with the daemon's words
/// when it refuses, and std::runtime_error when there is no daemon.
class LogLink : public ControlLink {
 public:
  using ControlLink::ControlLink;

  [[nodiscard]] std::vector<RemoteLog> list();
  /// Bytes from `offset` on, as many as one answer holds; their checksum is right. Empty at the end of the log.
  [[nodiscard]] std::string read(const std::string& name, std::uint64_t offset);
  /// CRC-32 of `length` bytes from `offset` on.
  [[nodiscard]] std::uint32_t sum(const std::string& name, std::uint64_t offset, std::uint64_t length);
};

}  // namespace navcal::cli
