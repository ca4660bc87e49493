// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "config/settings.h"
#include "pipeline/pipeline.h"
#include "record/port_matching.h"
#include "record/recording.h"

namespace navcal::analysis {

/// Receiver of a replay: what the pipeline makes of the bytes, and what does not follow from them.
class ReplaySink : public pipeline::Sink {
 public:
  /// An order to the motor card as it was logged.
  virtual void on_command(const record::LoggedCommand& /*command*/) {}
};

/// Recordings of one series through the pipeline, one entry after the other, as the daemon took them: samples are
/// bit-identical to the daemon's.
class ReplayRun {
 public:
  explicit ReplayRun(const config::Settings& settings) : pipeline_(settings) {}

  /// The next recording of the series; `file` names it in remarks.
  void open(std::unique_ptr<record::Recording> recording, std::string file);
  /// Plays one entry. False at the end of the recording, when everything that waited has been given up. Throws
  /// record::BadRecording.
  bool step(ReplaySink& sink);

  /// How far the open recording has been read, 0 to 1.
  [[nodiscard]] double progress() const { return recording_->progress(); }
  /// Of one port of the settings.
  [[nodiscard]] pipeline::PortStatistics statistics(std::uint16_t port) const {
    return pipeline_.statistics(port);
  }
  /// Irregularities so far, each with its file.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  void take(const record::Entry& entry, ReplaySink& sink);
  void take_event(const record::LoggedEvent& event, ReplaySink& sink);
  void finish(ReplaySink& sink);

  pipeline::Pipeline pipeline_;
  std::unique_ptr<record::Recording> recording_;
  std::unique_ptr<record::PortMatch> ports_;
  std::string file_;
  std::int64_t newest_ns_ = 0;
  bool ended_ = true;
  std::vector<std::string> remarks_;
};

}  // namespace navcal::analysis
