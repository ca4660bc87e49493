// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include "cli/live/doctor_checks.h"
#include "cli/live/result_file.h"
#include "record/log/disk.h"

namespace navcal::cli {
namespace {

constexpr double kMegabyte = 1e6;

/// Seconds from a record to its being safe, the longest of a few tries.
double slowest_sync_s(const std::filesystem::path& folder, std::error_code& error) {
  constexpr std::size_t kRecord = 16'384;  // some seconds of a vehicle's data
  constexpr int kTries = 8;
  record::Disk& disk = record::real_disk();
  const auto file = folder / fmt::format(".navcal-doctor-{}", ::getpid());
  double slowest_s = 0;
  {
    const auto opened = disk.create(file, error);
    if (!opened) return slowest_s;
    const std::string record(kRecord, '\xa5');
    for (int i = 0; i < kTries && !error; ++i) {
      const auto began = std::chrono::steady_clock::now();
      error = opened->write_at(static_cast<std::uint64_t>(i) * kRecord, record);
      if (!error) error = opened->sync();
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
      slowest_s = std::max(slowest_s, took.count());
    }
  }
  (void)disk.remove(file);
  return slowest_s;
}

/// The shipped unit (ProtectSystem=strict) writes to its state folder only, and where a drop-in allows it.
bool service_may_write(std::string folder, const std::filesystem::path& etc) {
  folder += '/';
  if (folder.starts_with("/var/lib/navcal/")) return true;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(etc / "systemd/system/navcald.service.d", none)) {
    std::ifstream file(entry.path());
    for (std::string path; file >> path;) {
      if (constexpr std::string_view kKey = "ReadWritePaths="; path.starts_with(kKey)) path.erase(0, kKey.size());
      if (path.starts_with('/') && folder.starts_with(path + '/')) return true;
    }
  }
  return false;
}

}  // namespace

Finding fix_log_folder(const config::LogSettings& settings, const Account& account,
                       const std::filesystem::path& etc) {
  std::string name = settings.directory.string();
  const std::string folder = name;
  if (!settings.enabled || account.name != kServiceUser || service_may_write(folder, etc))
    return good("fix", "nothing to write: no service is kept from the log folder");
  std::replace(name.begin(), name.end(), '/', '-');
  const auto file = etc / "systemd/system/navcald.service.d" / ("log" + name + ".conf");
  constexpr std::string_view kMeantBySystemd = " \t\n\"'\\%$";
  const std::string by_hand = "`sudo systemctl edit navcald`";
  if (std::filesystem::exists(file)) return fault("fix", file.string() + " is there and stays as it is", by_hand);
  if (folder.find_first_of(kMeantBySystemd) != std::string::npos)
    return fault("fix", folder + ": the name has letters that systemd wants escaped", by_hand);
  std::filesystem::create_directories(file.parent_path());
  write_result(file, fmt::format("[Unit]\nRequiresMountsFor={0}\n\n[Service]\nReadWritePaths={0}\n", folder));
  return good("fix", fmt::format("{} is new: navcald.service waits for the mount of {} and may write there. It "
                                 "holds after `sudo systemctl daemon-reload && sudo systemctl restart navcald`",
                                 file.string(), folder));
}

Finding check_log_folder(const config::LogSettings& settings, const Account& account,
                         const std::filesystem::path& etc) {
  const std::string topic = "log";
  if (!settings.enabled) return good(topic, "off");
  const std::string folder = settings.directory.string();
  std::error_code error;
  if (!std::filesystem::is_directory(settings.directory, error)) {
    return fault(topic, folder + " is not there",
                 fmt::format("sudo install -d -m 750 -o {} {}", account.name, folder));
  }
  if (!may_read_and_write(account, settings.directory)) {
    return fault(topic, fmt::format("{}: {} may not write there", folder, account.name),
                 fmt::format("sudo chown {} {}", account.name, folder));
  }
  if (account.name == kServiceUser && !service_may_write(folder, etc)) {
    return fault(topic, folder + ": navcald.service may write to /var/lib/navcal only",
                 fmt::format("`sudo navcal doctor --fix` writes a drop-in: [Service] ReadWritePaths={0} and "
                             "[Unit] RequiresMountsFor={0}",
                             folder));
  }
  const auto free_bytes = record::real_disk().free_bytes(settings.directory, error);
  if (error) return fault(topic, folder + ": " + error.message(), "look at `df -h " + folder + "`");
  const double free_MB = static_cast<double>(free_bytes) / kMegabyte;
  if (free_bytes < settings.free_floor_bytes + settings.rotate_bytes) {
    return warning(topic,
                   fmt::format("{}: {:.0f} MB are free; a file of the log takes {:.0f} MB, and {:.0f} MB are kept "
                               "free by deleting the oldest",
                               folder, free_MB, static_cast<double>(settings.rotate_bytes) / kMegabyte,
                               static_cast<double>(settings.free_floor_bytes) / kMegabyte),
                   "copy logs away, or lower log.rotate_MB and log.free_floor_MB");
  }
  const double sync_s = slowest_sync_s(settings.directory, error);
  if (error == std::errc::permission_denied) {
    // Another user's folder, in which the service may write and we may not.
    return good(topic, fmt::format("{}, {:.0f} MB free; its speed can be measured by {} only", folder, free_MB,
                                   account.name));
  }
  if (error) {
    return fault(topic, fmt::format("{}: writing a record failed: {}", folder, error.message()),
                 "look at `df -h " + folder + "` and at `dmesg`");
  }
  const std::string speed =
      fmt::format("{}, {:.0f} MB free, a record is safe after {:.3g} ms at most", folder, free_MB, sync_s * 1e3);
  if (sync_s > settings.sync_interval_s) {
    return warning(topic, speed,
                   fmt::format("slower than log.sync_interval_s = {}: a power cut loses more; use a faster medium",
                               settings.sync_interval_s));
  }
  return good(topic, speed);
}

}  // namespace navcal::cli
