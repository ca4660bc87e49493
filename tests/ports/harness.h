// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.h"
#include "ports/port.h"
#include "ports/pty_host.h"
#include "tests/support/temporary_folder.h"

namespace navcal::ports::testing {

using Folder = test::TemporaryFolder;

/// Runs the context until the condition holds. False when it does not within a time that no machine needs.
bool run_until(boost::asio::io_context& io, const std::function<bool()>& condition,
               std::chrono::milliseconds limit = std::chrono::seconds(20));
void run_for(boost::asio::io_context& io, std::chrono::milliseconds duration);

protocols::Bytes bytes_of(std::string_view text);

/// Remembers everything that a port reports.
class Recorder : public PortListener {
 public:
  void on_opened(std::int64_t now_ns, const OpenPort& port) override;
  void on_bytes(std::int64_t arrival_ns, protocols::Bytes bytes) override;
  void on_sent(std::int64_t now_ns, protocols::Bytes bytes) override;
  void on_dropped(protocols::Bytes bytes) override { dropped.append(bytes.begin(), bytes.end()); }
  void on_lost(std::int64_t now_ns, std::string_view reason) override;

  std::vector<OpenPort> opened;
  std::string received, sent;
  std::vector<std::int64_t> arrivals_ns;
  std::vector<std::string> lost;
  std::function<void()> at_bytes;  ///< called from within on_bytes
  std::string dropped;
};

config::PortSettings settings_for(const std::filesystem::path& path, int baud = 9600);

/// A client's end of a pseudo-terminal, opened raw.
base::Descriptor open_client(const std::filesystem::path& path);
std::size_t open_descriptors();
/// CPU time that this process has used.
std::chrono::microseconds cpu_time();

}  // namespace navcal::ports::testing
