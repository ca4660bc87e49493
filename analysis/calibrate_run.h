// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "analysis/calibrate_history.h"
#include "calib/suite/report.h"
#include "config/settings.h"
#include "pipeline/pipeline.h"
#include "record/log/log_info.h"
#include "record/port_matching.h"
#include "record/recording.h"
#include "record/seen_recordings.h"

namespace navcal::analysis {

/// Recordings one after the other through the calibrators. Files of one series go on where the last ended; another
/// recording is another run of the instruments, whose clocks begin anew while the calibrators go on learning. What
/// was in force on the vehicle has no part in it, nor have the orders of its operator, but for the beginning of a
/// swing.
class CalibrateRun {
 public:
  /// `history` may be null: nothing is kept for pictures then.
  CalibrateRun(const config::Settings& settings, CalibrateHistory* history);

  /// `progress` gets the share of the file that was read, 0 to 1; what it throws ends the run. Throws
  /// record::BadRecording.
  void play(
      const std::string& file, const record::Progress& progress = [](double) {},
      const record::TimeWindow& window = {});
  /// No more files come.
  [[nodiscard]] calib::Report finish();

  /// After finish(): a state in which this calibrator's estimate is in force and nothing is learned yet; empty
  /// where the estimate is refused.
  [[nodiscard]] std::string state_with(calib::Calibrator calibrator);
  /// Before the first file: begins with a state of state_with().
  void begin_with(const std::string& state);

  [[nodiscard]] const config::Settings& settings() const { return settings_; }
  /// Duration of all files, without the pauses between them.
  [[nodiscard]] double duration_s() const { return static_cast<double>(duration_ns_) * 1e-9; }
  /// Irregularities, each with its file.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }
  /// Files that were played, in their order, without repetitions of recordings.
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }
  /// An autopilot's own calibration is still in the fields: an import says so, or a live log shows it.
  [[nodiscard]] bool has_corrected_fields() const { return has_corrected_fields_; }
  /// One of the recordings was imported from a log of PX4.
  [[nodiscard]] bool is_of_px4() const { return is_of_px4_; }
  /// As it is known at the end.
  [[nodiscard]] const pipeline::EarthField& earth_field() const { return pipeline_->earth_field(); }
  /// The port whose field serves; empty: none.
  [[nodiscard]] std::string field_port() const;

 private:
  void begin_recording(const std::string& file, std::int64_t time_ns);
  void take(const std::string& file, const record::Entry& entry, const record::PortMatch& ports);
  void at(const std::string& file, std::int64_t time_ns);
  void begin_ordered();
  void tell_corrected_fields(const std::string& file);

  config::Settings settings_;
  CalibrateHistory* history_;
  pipeline::Sink& sink_;
  std::unique_ptr<pipeline::Pipeline> pipeline_;
  bool file_begins_ = true;
  std::int64_t newest_ns_ = 0;
  std::int64_t duration_ns_ = 0;
  std::vector<std::string> remarks_, files_;
  record::SeenRecordings seen_;
  bool has_corrected_fields_ = false, is_of_px4_ = false;
};

}  // namespace navcal::analysis
