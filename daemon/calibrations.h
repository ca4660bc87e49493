// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/settings.h"
#include "daemon/calibration_store.h"
#include "daemon/control_request.h"
#include "daemon/log_writer.h"
#include "daemon/status_server.h"
#include "pipeline/pipeline.h"

namespace navcal::daemon {

/// The daemon's side of the calibrators in its pipeline: CALIB on the status socket and in the log, the
/// operator's orders, and the state kept across restarts. It does nothing when there is nothing to calibrate.
class Calibrations {
 public:
  Calibrations(const config::Settings& settings, pipeline::Pipeline& pipeline, LogWriter& log,
               StatusServer& server);

  /// Called before the first bytes. Restores the state of the last run and writes it to the log.
  void begin(std::int64_t now_ns);
  /// Called by the pipeline.
  void on_change(const pipeline::CalibrationChange& change);
  /// Publishes CALIB to watching clients, and now and then to the log.
  void report(std::int64_t now_ns);
  /// Saves the state when it is time.
  void tick(std::int64_t now_ns);
  /// Saves the state; the log gets a last CALIB.
  void stop(std::int64_t now_ns);

  /// Sets the states of the calibrations that compasses make of themselves, members of a JSON object, which CALIB
  /// shows beside ours.
  void set_compasses(std::string members) { compasses_ = std::move(members); }
  /// A calibration.* command; its answer, newline included.
  [[nodiscard]] std::string answer(const ControlRequest& request, std::int64_t now_ns, pipeline::Sink& sink);
  /// Notices since the last call, for people.
  [[nodiscard]] std::vector<std::string> take_notices() { return store_.take_notices(); }

 private:
  void save(std::int64_t now_ns);
  void report(std::int64_t now_ns, bool into_log);
  [[nodiscard]] std::string beginning(std::int64_t now_ns);

  pipeline::Pipeline& pipeline_;
  LogWriter& log_;
  StatusServer& server_;
  CalibrationStore store_;
  std::string compasses_;
  std::int64_t next_save_ns_ = 0;
  std::int64_t next_log_ns_ = 0;
  bool changed_ = false;  ///< not saved and reported yet
};

}  // namespace navcal::daemon
