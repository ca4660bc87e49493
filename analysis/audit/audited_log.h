// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/calibrate_history.h"
#include "analysis/import/import_formats.h"
#include "analysis/noise/noise_run.h"
#include "calib/suite/report.h"
#include "pipeline/earth_field.h"
#include "pipeline/pipeline.h"
#include "record/recording.h"

namespace navcal::analysis {

struct AuditRequest {
  std::string file;
  ImportOptions import{};
  record::TimeWindow window{};
  /// Called with the log or capture that is read, which may be a temporary one, for what other rooms look for.
  std::function<void(const std::string& recording)> also{};
};

/// Samples of one kind from one port.
struct AuditedStream {
  std::string channel, kind;   ///< port, with the kind where it has several; "imu", "compass"
  std::vector<double> time_s;  ///< of validity, seconds from the first sample, in the order in which they came
  std::uint64_t vectors = 0;   ///< readings with three axes (field, rates, force), ...
  std::uint64_t repeated = 0;  ///< ... and of these the ones equal to the one before in every axis
  double longest_equal_s = 0;  ///< the longest time without a new reading
};

/// A calibration of the compass from a part of the log.
struct AuditedCalibration {
  calib::Report report;
  std::vector<TurnedSample> samples;
};

/// All that the findings are made from. Parts that the file lacks are empty.
struct AuditedLog {
  std::string file;
  bool is_partial = false;  ///< reading was ended before the end of the file
  double duration_s = 0;
  std::int64_t begin_utc_ns = 0;          ///< of time 0
  std::vector<RecordedChannel> channels;  ///< in people's units
  std::vector<Interval> rest;             ///< parts in which the vehicle is at rest
  std::vector<AuditedStream> streams;
  std::map<std::string, pipeline::PortStatistics> ports;
  std::optional<pipeline::EarthField> earth;
  std::string compass;       ///< port from which the calibrators learn; empty: none
  double compass_lag_s = 0;  ///< taken off its times before the calibrators learn
  AuditedCalibration whole;
  /// Standard errors of headings by port: constant where they are those of the configuration.
  std::map<std::string, Series> heading_std_deg;
  std::array<AuditedCalibration, 2> halves;  ///< fitted to the first and to the second half only
  std::vector<std::string> remarks;
  bool states_times = true;             ///< else the import has placed the bytes evenly
  std::set<std::string> true_headings;  ///< ports whose headings are from true north

  [[nodiscard]] const RecordedChannel* find(std::string_view port, std::string_view quantity) const;
  /// value_at() of a channel; nullopt where there is none.
  [[nodiscard]] std::optional<double> at(std::string_view port, std::string_view quantity, double time_s,
                                         double most_apart_s) const;
  /// Channels of this quantity, one for each port that has it.
  [[nodiscard]] std::vector<const RecordedChannel*> all(std::string_view quantity) const;
  /// Typical speed under way by receiver or Doppler log; 1 m/s where neither tells.
  [[nodiscard]] double speed_m_s() const;
};

/// Linear between the readings on both sides of a time; nullopt where there are none, or they are too far apart.
[[nodiscard]] std::optional<double> value_at(const Series& series, double time_s, double most_apart_s);

/// Called with the part of the work and its share, 0 to 1. False ends the reading; what was read counts.
using KeepGoing = std::function<bool(std::string_view part, double share)>;

/// Reads a log of navcal, a capture, the bytes of a device or a log of another system. Throws
/// record::BadRecording.
[[nodiscard]] AuditedLog load_audited(const AuditRequest& request, const KeepGoing& keep_going);

}  // namespace navcal::analysis
