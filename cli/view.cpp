// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "analysis/import/import_log.h"
#include "analysis/log_builder.h"
#include "base/printable.h"
#include "base/spawn.h"
#include "base/temporary_folder.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "record/recording.h"
#include "web/viewer.h"

namespace navcal::cli {
namespace {

struct ViewArguments {
  std::string file;
  std::uint16_t port = 0;
  double speed = 1;
  bool no_open = false;
};

/// A log of a capture, or of a log of another system.
std::filesystem::path log_of(const std::string& file, const std::filesystem::path& folder) {
  std::filesystem::path log = folder / "recording.mcap";
  std::vector<std::string> remarks;
  const bool is_foreign = run_log_job([&](const record::Progress&) { return analysis::is_foreign_log(file, {}); });
  if (is_foreign) {
    remarks = run_log_job([&](const record::Progress& progress) {
                return analysis::import_log(file, log, {}, progress);
              }).remarks;
  } else {
    remarks = run_log_job(
        [&](const record::Progress& progress) { return analysis::import_capture(file, log, progress); });
  }
  tell_remarks("navcal view", remarks);
  return log;
}

/// Opens the page where there is a display. Without xdg-open nothing happens: the address was printed.
void open_browser(const std::string& address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  // What the browser prints is nothing to the reader of this program's output, and its end is not waited for.
  try {
    (void)base::spawn({.command = {"xdg-open", address}});
  } catch (const std::system_error&) {
    fmt::print(stderr, "navcal view: there is no xdg-open; open the address by hand\n");
  }
}

void view(const ViewArguments& arguments) {
  std::optional<base::TemporaryFolder> folder;
  web::ViewerSettings settings;
  const bool is_log = run_log_job([&](const record::Progress&) { return record::is_log(arguments.file); });
  if (!is_log) folder.emplace();
  settings.log = is_log ? std::filesystem::path(arguments.file) : log_of(arguments.file, folder->path());
  settings.name = std::filesystem::path(arguments.file).filename().string();
  settings.version = NAVCAL_VERSION;
  settings.port = arguments.port;
  settings.speed = arguments.speed;
  base::Progress progress("view");
  settings.progress = [&](double done) { progress.show(done); };
  settings.remark = [](const std::string& remark) {
    fmt::print(stderr, "navcal view: {}\n", base::printable(remark));
  };
  settings.ready = [&](const std::string& address) {
    std::printf("navcal view: %s\n", address.c_str());
    std::fflush(stdout);
    if (!arguments.no_open) open_browser(address);
  };
  web::view_recording(settings);
}

}  // namespace

void add_view(CLI::App& app) {
  const auto [command, arguments] =
      add_command<ViewArguments>(app, "view", "show a recording in the browser", view);
  command->add_option("FILE", arguments->file)->required();
  add_defaulted(command, "--port", arguments->port);
  add_number(command, "--speed", 0.001, 1e6, arguments->speed);
  command->add_flag("--no-open", arguments->no_open);
}

}  // namespace navcal::cli
