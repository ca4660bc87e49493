// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/log_choice.h"
#include "config/settings.h"
#include "daemon/disk_thread.h"
#include "daemon/status_server.h"
#include "pipeline/utc_mapping.h"
#include "record/log/log_encoder.h"

namespace navcal::daemon {

/// "navigation, raw.gps"; "nothing" for an empty list. The message of an event log.left_out.
[[nodiscard]] std::string words_for_choice(const std::vector<std::string>& leave_out);

/// Front end of the log for the I/O thread: encodes records into the disk thread's buffer, decides when a new
/// file begins, and reports lost records. It writes nothing when the log is switched off. Clients
/// of the status socket that ask for RECORD (docs/status-protocol.md) get every JSON message, also those that are
/// not logged; nothing is encoded while nobody asks.
class LogWriter : public record::LogMessages<LogWriter> {
 public:
  /// Begins the first file, as soon as the log folder can be taken; state() tells.
  LogWriter(const config::Settings& settings, std::int64_t now_ns, const pipeline::UtcMapping& mapping);

  /// `server` must live as long as this object.
  void tell(StatusServer& server) { server_ = &server; }

  void raw(std::uint16_t port, record::Direction direction, std::int64_t time_ns, protocols::Bytes bytes);
  /// A message of the log, for the clients, and for the file if it has such.
  void put(const record::MessageHead& head, const record::AppendJson& append);
  [[nodiscard]] std::string_view port_name(std::uint16_t port) const { return ports_[port]; }
  /// Unlike calib(), which a replay needs and which is never left out.
  void calib_report(std::int64_t now_ns, std::string_view json);
  /// Sets the source of the calibration object for /calib. Every later file begins with it, besides
  /// configuration and time.
  void begin_files_with(std::function<std::string(std::int64_t)> calibration) {
    calibration_ = std::move(calibration);
  }

  /// Ends the file and writes nothing until start(); records of that time are not logged.
  void stop(std::int64_t now_ns);
  /// Begins a new file after stop().
  void start(std::int64_t now_ns);
  [[nodiscard]] bool is_stopped() const { return stopped_; }

  /// What is not logged from now on, as in config/log_choice.h, which has checked it. Each later file says so in
  /// an event log.left_out at its beginning.
  void leave_out(std::vector<std::string> choice);
  [[nodiscard]] const std::vector<std::string>& left_out() const { return settings_.leave_out; }

  /// Ends this file and begins another; nothing while the log is stopped.
  void rotate(std::int64_t now_ns);
  /// Called about once a second: rotates by size and age, and writes the event that reports lost records.
  void tick(std::int64_t now_ns);
  /// Ends the file and waits until it is on the disk.
  void finish(std::int64_t now_ns);

  [[nodiscard]] bool enabled() const { return disk_ != nullptr; }
  [[nodiscard]] DiskState state() const;
  /// Notices of the disk thread, for people.
  [[nodiscard]] std::vector<std::string> take_notices();

 private:
  void begin_file(std::int64_t now_ns);
  [[nodiscard]] bool has(config::LogGroup group) const { return !left_out_.at(static_cast<std::size_t>(group)); }
  void publish(const record::MessageHead& head, const record::AppendJson& append);
  template <class Encode>
  void append(Encode&& encode);

  config::LogSettings settings_;
  StatusServer* server_ = nullptr;
  std::string line_;  ///< of a RECORD
  record::LogEncoder encoder_;
  std::unique_ptr<DiskThread> disk_;
  std::function<std::string(std::int64_t now_ns)> calibration_;
  std::int64_t file_begun_ns_ = 0;
  std::uint64_t told_dropped_ = 0;
  std::string told_gone_;                                   ///< the last file that somebody has removed
  std::vector<std::string> ports_;                          ///< their names
  std::array<bool, config::kLogGroups.size()> left_out_{};  ///< by LogGroup
  std::vector<bool> raw_left_out_;                          ///< by port
  bool stopped_ = false;
};

}  // namespace navcal::daemon
