// SPDX-License-Identifier: Apache-2.0
#include "daemon/calibrations.h"

#include "daemon/json_text.h"
#include "record/json/calibration_json.h"

namespace navcal::daemon {
namespace {

/// Interval at which learnt state is saved; a loss of power costs at most this. Active corrections are saved at
/// once.
constexpr std::int64_t kSaveInterval_ns = 300'000'000'000;
/// Interval of CALIB in the log. It is long because CALIB changes slowly and flash wears.
constexpr std::int64_t kLogInterval_ns = 30'000'000'000;

}  // namespace

Calibrations::Calibrations(const config::Settings& settings, pipeline::Pipeline& pipeline, LogWriter& log,
                           StatusServer& server)
    : pipeline_(pipeline), log_(log), server_(server), store_(settings) {}

void Calibrations::begin(std::int64_t now_ns) {
  if (!pipeline_.calibrates()) return;
  if (const auto state = store_.load()) {
    if (pipeline_.restore_calibration(*state)) {
      pipeline_.begin_calibration_run();
    } else {
      store_.reject("it was written by another version of the program");
    }
  }
  log_.calib(now_ns, beginning(now_ns));
  log_.begin_files_with([this](std::int64_t at_ns) { return beginning(at_ns); });
  next_save_ns_ = now_ns + kSaveInterval_ns;
}

std::string Calibrations::beginning(std::int64_t now_ns) {
  std::string json;
  record::append_json(json, pipeline_.mapping(), pipeline_.calibration_beginning(now_ns));
  return json;
}

void Calibrations::on_change(const pipeline::CalibrationChange& change) {
  std::string json;
  record::append_json(json, pipeline_.mapping(), change);
  log_.calib(change.time_ns, json);
  changed_ = true;
}

void Calibrations::report(std::int64_t now_ns) { report(now_ns, now_ns >= next_log_ns_); }

void Calibrations::report(std::int64_t now_ns, bool into_log) {
  const bool watched = server_.watched(ReportClass::calib);
  if (!pipeline_.calibrates() || (!into_log && !watched)) return;
  const auto& mapping = pipeline_.mapping();
  const bool utc_known = mapping.source != pipeline::UtcMapping::Source::none;
  const auto lines =
      record::calib_lines(pipeline_.calibration_report(),
                          utc_known ? std::optional(mapping.to_utc(now_ns)) : std::nullopt, compasses_);
  std::uint16_t slot = 0;
  for (const std::string& line : lines) {
    if (into_log) log_.calib_report(now_ns, line);
    if (watched) server_.publish(ReportClass::calib, line + "\r\n", slot++);
  }
  if (into_log) next_log_ns_ = now_ns + kLogInterval_ns;
}

void Calibrations::tick(std::int64_t now_ns) {
  if (!pipeline_.calibrates()) return;
  if (changed_ || now_ns >= next_save_ns_) save(now_ns);
  if (changed_) report(now_ns, true);
  changed_ = false;
}

void Calibrations::stop(std::int64_t now_ns) {
  if (pipeline_.calibrates()) {
    report(now_ns, true);
    save(now_ns);
  }
  store_.stop();
}

void Calibrations::save(std::int64_t now_ns) {
  store_.save(pipeline_.calibration_beginning(now_ns).state);
  next_save_ns_ = now_ns + kSaveInterval_ns;
}

std::string Calibrations::answer(const ControlRequest& request, std::int64_t now_ns, pipeline::Sink& sink) {
  const auto calibrator = calib::calibrator_named(request.calibrator);
  if (!calibrator) {
    std::string known;
    for (const auto one : calib::calibrators()) {
      known += known.empty() ? "" : ", ";
      known += calib::name_of(one);
    }
    return control_error("\"calibrator\" must be one of " + known);
  }
  const auto accept = request.force ? pipeline::CalibrationOrder::force : pipeline::CalibrationOrder::accept;
  const auto order = request.command == ControlCommand::calibration_accept ? accept
                     : request.command == ControlCommand::calibration_rollback
                         ? pipeline::CalibrationOrder::roll_back
                         : pipeline::CalibrationOrder::start;
  const std::string why_not = pipeline_.order_calibration(order, *calibrator, now_ns, sink);
  if (!why_not.empty()) return control_error(why_not);
  tick(now_ns);
  std::string out = R"({"ok":true,"name":)";
  append_quoted(out, pipeline_.calibration_report().name.text());
  out += "}\n";
  return out;
}

}  // namespace navcal::daemon
