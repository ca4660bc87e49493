// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gap/verdict/diagnosis.h"
#include "gap/watch/change_detector.h"
#include "gap/watch/window_source.h"
#include "pipeline/pipeline.h"

namespace navcal::gap {

/// What a watch knows after a window.
struct WatchReport {
  enum class Verdict : std::uint8_t { no_gap, gap, named, unknown };
  struct Cause {
    std::string effect;
    double probability = 0;
    double strength = 0;        ///< typical values
    std::int64_t since_ns = 0;  ///< begin of the window at which it most probably began, UTC
  };
  Verdict verdict = Verdict::no_gap;
  std::uint64_t windows = 0, skipped = 0;  ///< judged; not judged
  std::int64_t newest_ns = 0;              ///< end of the newest window, UTC
  double evidence_nats = 0;                ///< logarithm of the statistic
  double threshold_nats = 0;               ///< at which the alarm is raised
  std::optional<std::int64_t> alarm_ns;    ///< end of the window that raised it, UTC
  std::vector<Cause> causes;               ///< after an alarm: at most kMostCauses, the most probable first
  std::vector<WhereEntry> where;           ///< after an alarm: the clearest cells of the residual map
  std::string unexplained;                 ///< channel that the leading cause leaves unexplained; empty: none

  static constexpr std::size_t kMostCauses = 5;
};
/// "no_gap", "gap", "named", "unknown".
[[nodiscard]] std::string_view name_of(WatchReport::Verdict verdict);

/// Something that a watch tells.
struct WatchEvent {
  enum class Kind : std::uint8_t {
    window,   ///< one more window was judged
    skipped,  ///< one could not be judged; `reason` says why
    alarm,    ///< a gap is there
    cause,    ///< the cause has a name, or another one than before
    unknown,  ///< no effect of the library explains what is seen
  };
  Kind kind = Kind::window;
  std::int64_t time_ns = 0;  ///< end of the window, UTC
  std::string reason;
};

/// Watches a mission while it is sailed: takes samples as they come, judges a window every kWindow_s, and raises
/// an alarm when the evidence of a gap exceeds a threshold that does not depend on how long one has watched.
class Watch final : public pipeline::Sink {
 public:
  struct Options {
    double false_alarms_per_h = 0.001;  ///< at most, on average
  };
  using Listener = std::function<void(const WatchEvent&)>;
  /// `source` must outlive it.
  Watch(WindowSource& source, const Options& options, Listener listener);

  void on_sample(const instruments::Sample& sample) override;
  /// A command to the motor card. Times are on the scale of the samples.
  void on_order(std::int64_t time_ns, const Order& order);
  /// Judges what is complete although no later sample has come.
  void finish();

  [[nodiscard]] const WatchReport& report() const { return report_; }

  /// What the watch has learnt so far. A later run goes on from it.
  struct State {
    ChangeDetector::State change;
    Eigen::VectorXd log_power;
    std::vector<std::int64_t> begins_ns;  ///< of the windows judged, UTC
    std::uint64_t skipped = 0;
    std::optional<std::int64_t> alarm_ns;
    std::vector<double> of_source;
  };
  [[nodiscard]] State state() const;
  /// Throws std::invalid_argument for a state of another source.
  void restore(State state);

 private:
  void judge_window();
  void take(std::int64_t end_ns);
  void look_for_cause();
  void look_closer();
  void tell(WatchEvent::Kind kind, std::int64_t time_ns, std::string reason = {});
  [[nodiscard]] double evidence_nats() const;

  WindowSource& source_;
  Listener listener_;
  std::int64_t settling_ns_;
  ChangeDetector change_;
  PowerDetector power_;           ///< of the vehicle with its tolerances
  PowerDetector rest_of_leader_;  ///< with the leading cause in the model, since it leads
  PowerDetector rest_of_all_;     ///< with all effects in the model, since the alarm

  std::deque<instruments::Sample> samples_;
  std::deque<TimedOrder> orders_;
  std::optional<std::int64_t> begin_ns_;  ///< of the window that is being gathered
  std::int64_t newest_ns_ = 0;
  std::int64_t utc_minus_stamps_ns_ = 0;
  std::vector<std::int64_t> begins_ns_;
  std::optional<std::size_t> leader_;
  std::string named_;  ///< the cause that was told
  bool is_unknown_ = false;
  WatchReport report_;
};

}  // namespace navcal::gap
