#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/interruptible.h"
#include "cli/progress.h"
#include "record/export.h"
#include "record/log_info.h"
#include "record/log_repair.h"
#include "record/recording.h"

namespace navcal::cli {
namespace {

/// Runs a job with progress; turns what it throws into the statuses of the contract.
template <class Job>
auto run(Job job) {
  const Interruptible interruptible;
  Progress progress("log");
  try {
    return job(record::Progress([&progress](double done) {
      if (Interruptible::interrupted()) throw Failure(Exit::failed, "interrupted: nothing was written");
      progress.show(done);
    }));
  } catch (const record::BadRecording& error) {
    throw Failure(Exit::bad_input, error.what());
  } catch (const std::system_error& error) {
    throw Failure(Exit::failed, error.what());
  }
}

void tell(const std::vector<std::string>& remarks) {
  for (const auto& remark : remarks) fmt::print(stderr, "navcal log: {}\n", remark);
}

void show_info(const std::string& file, bool json) {
  const auto info = run([&](const record::Progress& progress) { return record::read_info(file, progress); });
  if (!json) tell(info.remarks);
  std::fputs((json ? to_json(info) : to_text(info)).c_str(), stdout);
}

void finish(const std::string& file) {
  const bool log = run([&](const record::Progress&) { return record::is_log(file); });
  if (!log) throw Failure(Exit::bad_input, file + ": byte 0: not an MCAP file");
  const record::Repair repair = record::finish_log(record::real_disk(), file);
  if (!repair.reason.empty()) throw Failure(Exit::bad_input, repair.message());
  if (repair.error) throw Failure(Exit::failed, repair.message());
  fmt::print("{}\n", repair.message());
}

void export_log(const std::string& file, const std::string& csv, const std::string& capture) {
  const auto exported = run([&](const record::Progress& progress) {
    return csv.empty() ? record::export_capture(file, capture, progress) : record::export_csv(file, csv, progress);
  });
  tell(exported.remarks);
  for (const auto& path : exported.files) fmt::print("{}\n", path.string());
}

}  // namespace

void add_log(CLI::App& app) {
  struct Options {
    std::string file, csv, capture;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  auto* const log = app.add_subcommand("log", "what is in a log; give it its index; export it");
  log->require_subcommand(1);
  log->footer("Example: navcal log info navcal-20261121T023000Z-000123.mcap");

  auto* const info =
      log->add_subcommand("info", "ports, duration, messages, gaps, events and damage of a log or capture");
  info->add_option("FILE", options->file, "log (.mcap) or capture (.cap)")->required();
  info->add_flag("--json", options->json, "one JSON object instead of text");
  info->footer("Example: navcal log info --json dive.mcap");
  info->callback([options] { show_info(options->file, options->json); });

  auto* const end = log->add_subcommand("finish", "give an unfinished log its index; it becomes read-only");
  end->add_option("FILE", options->file, "log (.mcap)")->required();
  end->footer("Example: navcal log finish dive.mcap");
  end->callback([options] { finish(options->file); });

  auto* const out = log->add_subcommand("export", "topics as CSV files, or the raw bytes as a capture");
  out->add_option("FILE", options->file, "log (.mcap); with --cap also a capture")->required();
  auto* const csv = out->add_option("--csv", options->csv, "folder for one CSV file per topic");
  auto* const capture = out->add_option("--cap", options->capture, "capture file to write");
  csv->excludes(capture);
  out->footer("Example: navcal log export --csv dive/ dive.mcap");
  out->callback([options] {
    if (options->csv.empty() && options->capture.empty()) {
      throw CLI::RequiredError("one of --csv DIR and --cap FILE");
    }
    export_log(options->file, options->csv, options->capture);
  });
}

}  // namespace navcal::cli
