// SPDX-License-Identifier: Apache-2.0
#include "fleet/jobs.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <variant>

#include "analysis/calibrate_run.h"
#include "analysis/noise/noise_run.h"
#include "analysis/surfacing_run.h"
#include "diagnosis/diagnose_layout.h"
#include "diagnosis/layout_information.h"
#include "fleet/causes/information_json.h"
#include "gap/verdict/information.h"
#include "gap/verdict/request.h"
#include "protocols/device_types.h"
#include "record/json/calibration_json.h"
#include "record/recording.h"
#include "report/gap_report.h"
#include "report/noise_report.h"
#include "report/surfacings_report.h"

namespace navcal::fleet {
namespace {

/// UTC of the first bytes, by the first mapping of the recording.
std::optional<std::int64_t> began_utc_ns(record::Recording& recording) {
  std::optional<std::int64_t> first_ns;
  while (const auto entry = recording.next()) {
    if (const auto* read = std::get_if<record::RawRead>(&*entry); read != nullptr && !first_ns) {
      first_ns = read->time_ns;
    }
    if (const auto* change = std::get_if<record::MappingChange>(&*entry)) {
      return first_ns.value_or(change->time_ns) + change->mapping.offset_ns;
    }
  }
  return std::nullopt;
}

/// Who recorded and when: `vehicle_id`, `vehicle_name`, `began_utc_ns` (null: the recording tells no time), and
/// the serial numbers of the devices that measure turn rates (`gyro_serial`) and the field or heading
/// (`compass_serial`). Texts that the recording's configuration does not state are empty. Throws
/// record::BadRecording.
nlohmann::ordered_json recording_identity(const std::filesystem::path& file) {
  const auto recording = record::Recording::open(file);
  std::string gyro, compass;
  for (const config::PortSettings& port : recording->settings().ports) {
    const protocols::RoleSet delivers = protocols::device_row(port.protocol).delivers;
    if (delivers.has(config::Role::rates) && gyro.empty()) gyro = port.serial_number;
    if (delivers.has_any({config::Role::field, config::Role::heading}) && compass.empty())
      compass = port.serial_number;
  }
  nlohmann::ordered_json json{{"vehicle_id", recording->settings().vehicle.id},
                              {"vehicle_name", recording->settings().vehicle.name},
                              {"gyro_serial", gyro},
                              {"compass_serial", compass}};
  const auto began = began_utc_ns(*recording);
  json["began_utc_ns"] = began ? nlohmann::ordered_json(*began) : nlohmann::ordered_json();
  return json;
}

using JobJson = nlohmann::ordered_json;

config::Settings settings_of(const JobInput& input) {
  return input.settings ? *input.settings : record::Recording::open(input.recording)->settings();
}

gap::Request request_of(const JobInput& input) {
  gap::Request request;
  request.missions = {input.recording};
  request.vehicle = input.vehicle;
  request.settings = input.settings;
  request.cache = input.bank_folder;
  request.bank_missions = input.bank_missions;
  request.bank_seed = input.bank_seed;
  request.threads = input.threads;
  return request;
}

std::string text_of(const JobJson& json) {
  // A file name in a remark may be invalid UTF-8.
  return json.dump(-1, ' ', false, JobJson::error_handler_t::replace);
}

std::string bank_answer(const JobInput& input) {
  const gap::MadeBank made = gap::make_bank(request_of(input), [](std::string_view, double) {});
  if (!made.shortcoming.empty()) throw std::invalid_argument(made.shortcoming);
  return text_of({{"missions", made.missions}, {"seed", input.bank_seed}});
}

std::string gap_answer(const JobInput& input) {
  gap::Request request = request_of(input);
  request.cache_is_read_only = true;
  const gap::Progress silent = [](std::string_view, double) {};
  if (input.layout) request.bank_missions = gap::Request{}.bank_missions;  // it has none
  const gap::Diagnosis diagnosis =
      input.layout
          ? diagnosis::diagnose(request, {.layout = *input.layout, .excluded = {}}, input.nominals, silent)
          : gap::diagnose(request, silent);
  auto json = JobJson::parse(report::gap_json(diagnosis));
  json.erase("seconds");
  json["bank"].erase("seconds");
  return text_of(json);
}

std::string evidence_answer(const JobInput& input) {
  gap::Request request = request_of(input);
  request.cache_is_read_only = true;
  const gap::Progress silent = [](std::string_view, double) {};
  if (input.layout) request.bank_missions = gap::Request{}.bank_missions;  // it has none
  const auto [result, vehicle_error] =
      input.layout ? diagnosis::information_of(request, *input.layout, input.nominals, silent)
                   : diagnosis::LayoutInformation{gap::information_of(request, silent), {}};
  JobJson json{{"identity", recording_identity(input.recording)}, {"remarks", result.remarks}};
  if (result.information) {
    json["information"] = information_json(*result.information);
    json["vehicle_error"] = std::vector<double>(vehicle_error.begin(), vehicle_error.end());
  } else {
    json["information"] = nullptr;
    json["shortcoming"] = result.shortcoming;
  }
  return text_of(json);
}

std::string calibrate_answer(const JobInput& input) {
  analysis::CalibrateRun run(settings_of(input), nullptr);
  run.play(input.recording.string());
  std::string text;
  record::append_calibrate_json(text, run.finish());
  auto json = JobJson::parse(text);
  json["duration_s"] = run.duration_s();
  json["remarks"] = run.remarks();
  json["identity"] = recording_identity(input.recording);
  return text_of(json);
}

std::string noise_answer(const JobInput& input) {
  auto json = JobJson::parse(
      report::noise_json(analysis::noise_of({input.recording.string(), {}, {}}, settings_of(input))));
  json.erase("file");
  return text_of(json);
}

std::string surfacings_answer(const JobInput& input) {
  analysis::SurfacingRun run(settings_of(input));
  run.play(input.recording.string());
  return text_of(JobJson::parse(report::surfacings_json(run.surfacings(), {})));
}

constexpr std::array kJobs{Job{"gap", true, true, gap_answer}, Job{"calibrate", false, false, calibrate_answer},
                           Job{"noise", false, false, noise_answer},
                           Job{"surfacings", false, false, surfacings_answer},
                           Job{"evidence", true, true, evidence_answer}};
constexpr Job kBank{kBankJob, true, false, bank_answer};

}  // namespace

std::span<const Job> jobs() { return kJobs; }

const Job& bank_job() { return kBank; }

const Job& job_named(std::string_view name) {
  if (name == kBankJob) return kBank;
  std::string names;
  for (const Job& job : kJobs) {
    if (job.name == name) return job;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", job.name);
  }
  throw std::invalid_argument(fmt::format("there is no job {}; there are {}", name, names));
}

}  // namespace navcal::fleet
