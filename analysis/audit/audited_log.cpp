// SPDX-License-Identifier: Apache-2.0
#include "analysis/audit/audited_log.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "analysis/audit/bounded.h"
#include "analysis/audit/heading_errors.h"
#include "analysis/calibrate_run.h"
#include "analysis/import/import_log.h"
#include "analysis/noise/channel_collector.h"
#include "analysis/replay_run.h"
#include "base/angles.h"
#include "base/durations.h"
#include "base/failure.h"
#include "base/temporary_folder.h"
#include "instruments/sample_fields.h"

namespace navcal::analysis {
namespace {

/// Ends a run of the calibrators; what they have learned stays.
struct ReadingEnded {};

/// Takes down samples by stream, and forwards them to the channels.
class AuditSink final : public ReplaySink {
 public:
  explicit AuditSink(AuditedLog& log, const config::Settings& settings)
      : log_(log), settings_(settings), sources_(settings), earth_(settings.environment) {}

  void on_sample(const instruments::Sample& sample) override {
    channels_.on_sample(sample);
    (void)sources_.take(sample);
    if (!begin_ns_) begin_ns_ = sample.stamp.validity_ns;
    const double time_s = base::seconds(sample.stamp.validity_ns - *begin_ns_);
    std::visit([&](const auto& value) { take(value, sample.port, time_s); }, sample.value);
    if (const auto* const gps = std::get_if<instruments::GpsSample>(&sample.value)) take_fix(*gps, sample.stamp);
  }

  void finish() {
    log_.duration_s = channels_.duration_s();
    log_.begin_utc_ns = channels_.begin_utc_ns();
    log_.channels = channels_.take_channels(settings_);
    leave_out_absent();
    for (auto& [key, open] : streams_) {
      const auto& [port, kind] = key;
      if (open.stream.vectors > 0 && !open.is_there) continue;
      const auto kinds = std::count_if(streams_.begin(), streams_.end(),
                                       [of = port](const auto& other) { return other.first.first == of; });
      open.stream.kind = kind;
      open.stream.channel = settings_.ports.at(port).name;
      if (kinds > 1) open.stream.channel.append(".").append(kind);
      log_.streams.push_back(std::move(open.stream));
    }
    if (const auto compass = sources_.learnt().compass; compass && begin_ns_)
      log_.compass = settings_.ports.at(*compass).name;
  }

 private:
  using Vectors = std::array<std::optional<instruments::Vector3>, 2>;
  struct OpenStream {
    AuditedStream stream;
    Vectors newest{};
    double since_s = 0;  ///< of the newest value
    bool is_there = false;
  };

  /// Rates, forces and fields that are zero all the time are of instruments that are not there.
  void leave_out_absent() {
    std::set<std::pair<std::string, std::string>> there;
    for (const RecordedChannel& channel : log_.channels) {
      const auto& values = channel.series.values;
      if (std::any_of(values.begin(), values.end(), [](double value) { return value != 0; }))
        there.emplace(channel.port, vector_of(channel));
    }
    std::erase_if(log_.channels, [&](const RecordedChannel& channel) {
      const std::string vector = vector_of(channel);
      return (vector == "rate" || vector == "force" || vector == "field" || vector == "yaw_rate") &&
             !there.contains({channel.port, vector});
    });
  }
  static std::string vector_of(const RecordedChannel& channel) {
    return channel.quantity.substr(0, channel.quantity.rfind('_'));
  }

  /// An imported fix states no UTC of its own.
  void take_fix(instruments::GpsSample fix, const instruments::Stamp& stamp) {
    if (!fix.time_utc_ns) fix.time_utc_ns = stamp.validity_utc_ns;
    if (earth_.take(fix)) log_.earth = earth_.field();
  }
  template <class Value>
  void take(const Value& value, std::uint16_t port, double time_s) {
    if constexpr (!std::is_same_v<Value, instruments::SkySample>) {
      OpenStream& open = streams_[{port, instruments::kKind<Value>.name}];
      if constexpr (std::is_same_v<Value, instruments::CompassSample>) {
        compare(open, {value.field_body_uT, {}}, time_s);
        if (value.heading_rad && value.heading_is_true) log_.true_headings.insert(settings_.ports.at(port).name);
        if (value.heading_std_rad) {
          Series& stated = log_.heading_std_deg[settings_.ports.at(port).name];
          stated.time_s.push_back(time_s);
          stated.values.push_back(*value.heading_std_rad * base::kDegreesPerRadian);
        }
      }
      if constexpr (std::is_same_v<Value, instruments::ImuSample>)
        compare(open, {value.rate_rad_s, value.specific_force_m_s2}, time_s);
      open.stream.time_s.push_back(time_s);
    }
  }
  static void compare(OpenStream& open, const Vectors& vectors, double time_s) {
    if (!vectors[0] && !vectors[1]) return;
    for (const auto& vector : vectors)
      open.is_there = open.is_there || (vector && *vector != instruments::Vector3{});
    if (++open.stream.vectors > 1 && vectors == open.newest) {
      ++open.stream.repeated;
      open.stream.longest_equal_s = std::max(open.stream.longest_equal_s, time_s - open.since_s);
    } else {
      open.newest = vectors;
      open.since_s = time_s;
    }
  }

  AuditedLog& log_;
  const config::Settings& settings_;
  pipeline::Sources sources_;
  pipeline::EarthFieldWatch earth_;
  ChannelCollector channels_;
  std::optional<std::int64_t> begin_ns_;
  std::map<std::pair<std::uint16_t, std::string_view>, OpenStream> streams_;
};

/// The readings as the devices sent them.
config::Settings without_estimates(config::Settings settings) {
  settings.calibration.enabled = settings.navigation.enabled = settings.battery.enabled = false;
  return settings;
}

void read_samples(AuditedLog& log, const std::string& file, const record::TimeWindow& window,
                  const KeepGoing& keep_going) {
  for (auto whole = record::Recording::open(file); const auto entry = whole->next();) {
    const auto* const event = std::get_if<record::LoggedEvent>(&*entry);
    if (event != nullptr && event->json.find(kNoTimes) != std::string::npos) log.states_times = false;
    if (std::holds_alternative<record::RawRead>(*entry)) break;
  }
  auto recording = record::Recording::open(file, window);
  const config::Settings settings = without_estimates(recording->settings());
  AuditSink sink(log, settings);
  ReplayRun run(settings);
  run.open(std::move(recording), log.file);
  while (!log.is_partial && run.step(sink)) log.is_partial = !keep_going("reading", run.progress());
  sink.finish();
  for (std::size_t i = 0; i < settings.ports.size(); ++i)
    log.ports.emplace(settings.ports[i].name, run.statistics(static_cast<std::uint16_t>(i)));
  log.remarks.insert(log.remarks.end(), run.remarks().begin(), run.remarks().end());
}

/// Takes the field of the motor off the readings that the findings are made from.
void subtract_motor(const AuditedLog& log, AuditedCalibration& from, const Eigen::Vector3d& slope_uT_per_A) {
  constexpr double kMostApart_s = 1;
  const auto currents = log.all("current");
  if (currents.empty()) return;
  for (TurnedSample& sample : from.samples) {
    const double time_s = base::seconds(sample.reading.utc_ns - log.begin_utc_ns);
    const auto current_A = value_at(currents.front()->series, time_s, kMostApart_s);
    if (sample.reading.field_body_uT && current_A) *sample.reading.field_body_uT -= *current_A * slope_uT_per_A;
  }
}

/// `state`: in which the field of the motor is in force, or empty. The same is returned.
std::string calibrate(AuditedLog& log, AuditedCalibration& into, const std::string& file,
                      const record::TimeWindow& window, const KeepGoing& keep_going, std::string_view part,
                      const std::string& state) {
  auto settings = record::Recording::open(file)->settings();
  settings.calibration.compass_delay_s = log.compass_lag_s;
  CalibrateHistory history(settings);
  CalibrateRun run(settings, &history);
  if (!state.empty()) run.begin_with(state);
  try {
    run.play(
        file,
        [&](double share) {
          if (!keep_going(part, share)) throw ReadingEnded{};
        },
        window);
  } catch (const ReadingEnded&) {
    log.is_partial = true;
  } catch (const record::NothingInWindow&) {  // of a half: it shows nothing
  }
  into.report = run.finish();
  into.samples = history.samples();
  if (const auto& motor = into.report.in_force.motor_current; motor && !state.empty())
    subtract_motor(log, into, motor->slope_uT_per_A);
  const auto* const motor = into.report.find(calib::Calibrator::motor_current);
  const bool is_told = motor != nullptr && motor->outcome == calib::Outcome::accepted;
  return is_told ? run.state_with(calib::Calibrator::motor_current) : std::string();
}

/// The windows of the two halves of a window.
std::array<record::TimeWindow, 2> halves_of(const AuditedLog& log, const record::TimeWindow& window) {
  const std::int64_t middle_ns =
      log.begin_utc_ns + static_cast<std::int64_t>(log.duration_s / 2 * static_cast<double>(base::kSecond_ns));
  const record::TimeBound middle{0, middle_ns};
  return {{{window.from, middle}, {middle, window.to}}};
}

/// A log or a capture of what `request` names, in `folder` where it is neither.
std::string readable(const AuditRequest& request, const base::TemporaryFolder& folder, AuditedLog& log,
                     const KeepGoing& keep_going) {
  const record::Progress progress = [&](double share) {
    if (!keep_going("importing", share))
      throw base::Failure(base::Exit::failed, "interrupted before " + request.file + " could be read");
  };
  const bool is_foreign = is_foreign_log(request.file, request.import);
  const auto device = is_foreign ? std::nullopt : device_of(request.file);
  if (!is_foreign && !device) return request.file;
  ImportOptions import = request.import;
  import.keeps_calibration = true;  // iron that the autopilot corrects is no finding
  std::string imported = (folder.path() / "audited.mcap").string();
  ImportReport report = device ? import_bytes(request.file, *device, 0, imported, progress)
                               : import_log(request.file, imported, import, progress);
  log.remarks = std::move(report.remarks);
  if (report.utc == ImportReport::Utc::unknown)
    log.remarks.emplace_back("the file states no UTC: times count from 2000-01-01");
  return imported;
}

}  // namespace

const RecordedChannel* AuditedLog::find(std::string_view port, std::string_view quantity) const {
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const RecordedChannel& channel) {
    return channel.port == port && channel.quantity == quantity;
  });
  return found == channels.end() ? nullptr : &*found;
}

std::optional<double> AuditedLog::at(std::string_view port, std::string_view quantity, double time_s,
                                     double most_apart_s) const {
  const RecordedChannel* const channel = find(port, quantity);
  return channel == nullptr ? std::nullopt : value_at(channel->series, time_s, most_apart_s);
}

std::vector<const RecordedChannel*> AuditedLog::all(std::string_view quantity) const {
  std::vector<const RecordedChannel*> found;
  for (const RecordedChannel& channel : channels) {
    if (channel.quantity == quantity && channel.channel != &scalar_channel()) found.push_back(&channel);
  }
  return found;
}

double AuditedLog::speed_m_s() const {
  constexpr double kUnderWay_m_s = 0.2, kUnknown_m_s = 1;
  std::vector<double> speeds;
  for (const auto& [one, other] :
       {std::pair{"velocity_north", "velocity_east"}, {"bottom_velocity_1", "bottom_velocity_2"}}) {
    for (const RecordedChannel* channel : all(one)) {
      for (std::size_t i = 0; i < channel->series.values.size(); ++i) {
        const auto across = at(channel->port, other, channel->series.time_s[i], 0);
        speeds.push_back(std::hypot(channel->series.values[i], across.value_or(0)));
      }
    }
  }
  std::erase_if(speeds, [](double speed) { return speed < kUnderWay_m_s; });
  return speeds.empty() ? kUnknown_m_s : quantile(speeds, 0.5);
}

std::optional<double> value_at(const Series& series, double time_s, double most_apart_s) {
  const auto after = std::lower_bound(series.time_s.begin(), series.time_s.end(), time_s);
  if (after == series.time_s.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(after - series.time_s.begin());
  if (*after == time_s) return series.values[i];
  if (i == 0 || *after - series.time_s[i - 1] > most_apart_s) return std::nullopt;
  const double share = (time_s - series.time_s[i - 1]) / (*after - series.time_s[i - 1]);
  return series.values[i - 1] * (1 - share) + series.values[i] * share;
}

AuditedLog load_audited(const AuditRequest& request, const KeepGoing& keep_going) {
  AuditedLog log;
  log.file = request.file;
  const base::TemporaryFolder folder;
  const std::string file = readable(request, folder, log, keep_going);
  try {
    read_samples(log, file, request.window, keep_going);
  } catch (const record::NothingInWindow& error) {
    // An imported log has a name that the user does not know.
    throw record::NothingInWindow(base::Exit::usage, request.file + std::string(error.what()).substr(file.size()));
  }
  log.rest = quiet_parts_of(log.channels, log.duration_s).intervals;
  if (request.also && !log.is_partial) request.also(file);
  if (log.is_partial || log.compass.empty()) return log;
  log.compass_lag_s = field_lag_s(log, log.compass);
  const auto state = calibrate(log, log.whole, file, request.window, keep_going, "calibrating", {});
  // The field of a steady current is no iron: where the motor's field is known, the rest is learned without it.
  if (!state.empty() && !log.is_partial)
    (void)calibrate(log, log.whole, file, request.window, keep_going, "calibrating without the motor", state);
  const auto halves = halves_of(log, request.window);
  for (std::size_t i = 0; i < halves.size() && !log.is_partial; ++i)
    (void)calibrate(log, log.halves.at(i), file, halves.at(i), keep_going, "judging", state);
  return log;
}

}  // namespace navcal::analysis
