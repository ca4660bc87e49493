// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/settings.h"
#include "daemon/disk_thread.h"
#include "instruments/samples.h"
#include "pipeline/navigation.h"
#include "pipeline/utc_mapping.h"
#include "record/log/log_encoder.h"

namespace navcal::daemon {

/// Front end of the log for the I/O thread: encodes records into the disk thread's buffer, decides when a new
/// file begins, and reports lost records. It does nothing when the log is switched off.
class LogWriter {
 public:
  /// Takes the log folder and begins the first file. Throws StartError saying what is wrong with the folder.
  LogWriter(const config::Settings& settings, std::int64_t now_ns, const pipeline::UtcMapping& mapping);

  void raw(std::uint16_t port, record::Direction direction, std::int64_t time_ns, protocols::Bytes bytes);
  void sample(const instruments::Sample& sample);
  void navigation(const pipeline::NavigationSample& sample);
  void mapping(std::int64_t now_ns, const pipeline::UtcMapping& mapping);
  void event(std::int64_t now_ns, std::string_view severity, std::string_view name, std::string_view port,
             std::string_view message);
  void health(std::int64_t now_ns, std::string_view json);
  void calib(std::int64_t now_ns, std::string_view json);

  void command(std::int64_t now_ns, std::string_view device, const control::OrderRecord& record);

  /// Sets the source of the calibration object for /calib. Every later file begins with it, besides
  /// configuration and time.
  void begin_files_with(std::function<std::string(std::int64_t)> calibration) {
    calibration_ = std::move(calibration);
  }

  /// Ends this file and begins another.
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
  template <class Encode>
  void append(Encode&& encode);

  config::LogSettings settings_;
  record::LogEncoder encoder_;
  std::unique_ptr<DiskThread> disk_;
  pipeline::UtcMapping mapping_;
  std::function<std::string(std::int64_t now_ns)> calibration_;
  std::int64_t file_begun_ns_ = 0;
  std::uint64_t told_dropped_ = 0;
};

}  // namespace navcal::daemon
