// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/pipeline.h"
#include "record/log/log_encoder.h"
#include "record/log/log_info.h"
#include "record/recording.h"
#include "record/whole_file.h"

namespace navcal::analysis {

/// Makes a log of bytes that come from elsewhere, as navcald would have written it: the bytes, and the samples,
/// estimates and calibrations that the pipeline makes of them. The file appears under its name only when it is
/// committed. Throws std::system_error.
class LogBuilder final : private pipeline::Sink {
 public:
  LogBuilder(const config::Settings& settings, const std::filesystem::path& log);

  /// To be called first; the log begins at this time with this mapping.
  void begin(const record::MappingChange& first);
  /// In the order of their times.
  void take(const record::RawRead& read);
  /// A mark of the capture, as an operator's mark stands in a log.
  void take(const record::LoggedEvent& event);
  /// An event at the time of the newest read.
  void tell(std::string_view severity, std::string_view name, std::string_view message);
  void commit();

  [[nodiscard]] const pipeline::Pipeline& pipeline() const { return pipeline_; }

 private:
  void on_sample(const instruments::Sample& sample) override;
  void on_mapping(const pipeline::UtcMapping& mapping) override;
  void on_navigation(const pipeline::NavigationSample& sample) override;
  void on_battery(const pipeline::BatterySample& sample) override;
  void on_alarm(const pipeline::AlarmChange& change) override;
  void on_stream_event(const pipeline::StreamEvent& event) override;
  void on_calibration(const pipeline::CalibrationChange& change) override;
  void flush();

  std::vector<config::PortSettings> ports_;
  record::LogEncoder encoder_;
  pipeline::Pipeline pipeline_;
  record::WholeFile file_;
  std::string text_;
  std::int64_t newest_ns_ = 0;
  bool begun_ = false;  ///< the file begins with the first mapping: it is no change
};

/// A log, as navcald would have written it of these bytes: raw bytes, and the samples, estimates and calibrations
/// that the pipeline makes of them, with the usual settings of each protocol. The file appears under its name only
/// when it is whole. Returns what is to be told to the user. Throws record::BadRecording, also when it is a log
/// already; std::system_error; what `progress` throws ends it too.
std::vector<std::string> import_capture(const std::filesystem::path& capture, const std::filesystem::path& log,
                                        const record::Progress& progress);

}  // namespace navcal::analysis
