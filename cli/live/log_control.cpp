// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "base/descriptor.h"
#include "base/failure.h"
#include "base/interruptible.h"
#include "base/printable.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/line_socket.h"
#include "record/json/base64.h"
#include "record/log/checksum.h"
#include "record/log/log_folder.h"

namespace navcal::cli {
namespace {

/// A log in the folder of a running navcald.
struct RemoteLog {
  std::string name;
  std::uint64_t bytes = 0;
  bool finished = false;
  std::string begin, end;  ///< UTC as the daemon writes it; empty: not known
};

/// The answer is a line of a third more.
constexpr std::uint64_t kLogPart_bytes = 49152;

[[noreturn]] void fail_log(const std::string& why) { throw base::Failure(base::Exit::failed, why); }

std::string text_or_nothing(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : "";
}

/// The log commands of navcald's control socket. Every function throws base::Failure with the daemon's words
/// when it refuses, and std::runtime_error when there is no daemon.
class LogLink : public ControlLink {
 public:
  using ControlLink::ControlLink;

  [[nodiscard]] std::vector<RemoteLog> list() {
    std::vector<RemoteLog> logs;
    try {
      for (bool more = true; more;) {
        const auto page = ask({{"command", "log.list"}, {"after", logs.empty() ? "" : logs.back().name}});
        for (const auto& log : page.at("files"))
          logs.push_back({log.at("name"), log.at("bytes"), log.at("finished"), text_or_nothing(log.at("begin")),
                          text_or_nothing(log.at("end"))});
        more = page.at("more").get<bool>() && !page.at("files").empty();
      }
    } catch (const nlohmann::json::exception& error) {
      fail_log(std::string("navcald's list of logs cannot be read: ") + error.what());
    }
    return logs;
  }
  /// Bytes from `offset` on, as many as one answer holds; their checksum is right. Empty at the end of the log.
  [[nodiscard]] std::string read(const std::string& name, std::uint64_t offset) {
    try {
      const auto part =
          ask({{"command", "log.read"}, {"file", name}, {"offset", offset}, {"length", kLogPart_bytes}});
      auto bytes = record::from_base64(part.at("data").get<std::string>());
      const bool is_right = bytes && part.at("offset") == offset && bytes->size() <= kLogPart_bytes &&
                            part.at("crc32") == record::crc32(*bytes);
      if (!is_right) fail_log(name + ": the checksum of a part is wrong");
      return std::move(*bytes);
    } catch (const nlohmann::json::exception& error) {
      fail_log(name + ": navcald's answer cannot be read: " + error.what());
    }
  }
  /// CRC-32 of `length` bytes from `offset` on.
  [[nodiscard]] std::uint32_t sum(const std::string& name, std::uint64_t offset, std::uint64_t length) {
    try {
      const auto part = ask({{"command", "log.sum"}, {"file", name}, {"offset", offset}, {"length", length}});
      if (part.at("length") != length) fail_log(name + ": it is shorter than navcald has said");
      return part.at("crc32").get<std::uint32_t>();
    } catch (const nlohmann::json::exception& error) {
      fail_log(name + ": navcald's answer cannot be read: " + error.what());
    }
  }
};

enum class Fetched { whole, was_there };

/// Bytes that are compared by one checksum.
constexpr std::uint64_t kFetchStep_bytes = 4 << 20;

[[noreturn]] void fail_fetch(const std::string& why) { throw base::Failure(base::Exit::failed, why); }

/// NAME.part, held by this process alone.
class PartFile {
 public:
  explicit PartFile(std::filesystem::path path)
      : path_(std::move(path)), file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644)) {
    if (!file_) fail("cannot be opened");
    if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) fail("another navcal is downloading it");
    struct stat status {};
    if (::fstat(file_.get(), &status) != 0) fail("cannot be read");
    bytes_ = static_cast<std::uint64_t>(status.st_size);
  }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  void append(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(bytes_));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail("cannot be written");
      bytes_ += static_cast<std::uint64_t>(n);
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
  }
  void cut(std::uint64_t bytes) {
    if (::ftruncate(file_.get(), static_cast<off_t>(bytes)) != 0) fail("cannot be cut");
    bytes_ = bytes;
  }
  [[nodiscard]] std::uint32_t sum(std::uint64_t offset, std::uint64_t length) const {
    std::string bytes(length, '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t n =
          ::pread(file_.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail("cannot be read");
      done += static_cast<std::size_t>(n);
    }
    return record::crc32(bytes);
  }
  /// On the disk, read-only as a finished log is, and under its name unless that is taken.
  void rename_to(const std::filesystem::path& target) const {
    if (::fsync(file_.get()) != 0 || ::fchmod(file_.get(), 0444) != 0) fail("cannot be finished");
    if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target.c_str(), RENAME_NOREPLACE) != 0)
      fail("cannot be renamed to " + target.filename().string());
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::system_error(base::last_error(), path_.string() + ": " + what);
  }

  std::filesystem::path path_;
  base::Descriptor file_;
  std::uint64_t bytes_ = 0;
};

/// Leading bytes of the part that are those of the log, in steps.
std::uint64_t right_bytes(LogLink& link, const std::string& name, const PartFile& part) {
  std::uint64_t right = 0;
  while (right < part.bytes()) {
    const std::uint64_t length = std::min(kFetchStep_bytes, part.bytes() - right);
    if (link.sum(name, right, length) != part.sum(right, length)) break;
    right += length;
  }
  return right;
}

/// Whether the log is there already. Throws when its name is taken by something else.
bool is_there(const std::filesystem::path& target, const RemoteLog& log) {
  std::error_code error;
  const auto status = std::filesystem::symlink_status(target, error);
  if (status.type() == std::filesystem::file_type::not_found) return false;
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(target, error) == log.bytes)
    return true;
  fail_fetch(target.string() + ": there is another file of this name; it is never overwritten");
}

/// Downloads a finished log into a folder. NAME.part grows there; one that is left of an earlier attempt is
/// continued as far as its bytes are those of the log. It is renamed to NAME once every byte has been compared by
/// checksum. A file of that name is never overwritten. `progress` gets the bytes that are there. Throws
/// base::Failure, std::system_error and what LogLink throws; NAME.part then stays.
Fetched fetch_log(LogLink& link, const RemoteLog& log, const std::filesystem::path& folder,
                  const std::function<void(std::uint64_t bytes)>& progress) {
  // The name comes from the daemon: it must not lead out of the folder.
  if (!record::is_log_name(log.name)) fail_fetch(log.name + ": not the name of a log");
  if (!log.finished) fail_fetch(log.name + ": it is being written; navcal log stop, or log.rotate, finishes it");
  const auto target = folder / log.name;
  if (is_there(target, log)) return Fetched::was_there;
  PartFile part(target.string() + ".part");
  if (part.bytes() > log.bytes) part.cut(log.bytes);
  part.cut(right_bytes(link, log.name, part));
  while (part.bytes() < log.bytes) {
    if (base::Interruptible::interrupted())
      fail_fetch(fmt::format("interrupted: {}.part has {} of {} bytes; the same command continues", log.name,
                             part.bytes(), log.bytes));
    const std::string bytes = link.read(log.name, part.bytes());
    if (bytes.empty() || bytes.size() > log.bytes - part.bytes()) fail_fetch(log.name + ": its size has changed");
    part.append(bytes);
    progress(part.bytes());
  }
  if (const std::uint64_t right = right_bytes(link, log.name, part); right < log.bytes) {
    part.cut(right);
    fail_fetch(fmt::format("{}: the bytes from {} on are not those of the log; the same command gets them again",
                           log.name, right));
  }
  part.rename_to(target);
  return Fetched::whole;
}

struct LogControlOptions {
  std::filesystem::path control = "/run/navcal/control";
  std::vector<std::string> files;
  std::filesystem::path to;
  std::vector<std::string> leave_out;
  bool everything = false;
  bool json = false;
};
using LogOptions = std::shared_ptr<LogControlOptions>;

void show_logs(const LogControlOptions& options) {
  LogLink link(options.control);
  nlohmann::json all = nlohmann::json::array();
  for (const RemoteLog& log : link.list()) {
    if (!options.json)
      fmt::print("{:<36} {:>12}  {:<24}  {}\n", base::printable(log.name), log.bytes, base::printable(log.begin),
                 log.finished ? base::printable(log.end) : "(being written)");
    all.push_back({{"name", log.name},
                   {"bytes", log.bytes},
                   {"finished", log.finished},
                   {"begin", log.begin.empty() ? nlohmann::json() : nlohmann::json(log.begin)},
                   {"end", log.end.empty() ? nlohmann::json() : nlohmann::json(log.end)}});
  }
  if (options.json) fmt::print("{}\n", all.dump());
}

/// Those that are wanted, or all that are finished.
std::vector<RemoteLog> wanted_logs(LogLink& link, const std::vector<std::string>& names) {
  std::vector<RemoteLog> logs = link.list();
  if (names.empty()) {
    std::erase_if(logs, [](const RemoteLog& log) { return !log.finished; });
    return logs;
  }
  std::vector<RemoteLog> wanted;
  for (const std::string& name : names) {
    const auto found =
        std::find_if(logs.begin(), logs.end(), [&](const RemoteLog& log) { return log.name == name; });
    if (found == logs.end())
      throw base::Failure(base::Exit::bad_input, name + ": navcald has no such log; navcal log list");
    wanted.push_back(*found);
  }
  return wanted;
}

void fetch_logs(const LogControlOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_directory(options.to, error))
    throw base::Failure(base::Exit::usage, options.to.string() + ": there is no such folder");
  const base::Interruptible interruptible;
  LogLink link(options.control);
  for (const RemoteLog& log : wanted_logs(link, options.files)) {
    base::Progress progress("log fetch");
    const auto fetched = fetch_log(link, log, options.to, [&](std::uint64_t bytes) {
      progress.show(base::printable(log.name), static_cast<double>(bytes) / static_cast<double>(log.bytes));
    });
    if (fetched == Fetched::whole) fmt::print("{}\n", (options.to / log.name).string());
    if (fetched == Fetched::was_there) fmt::print(stderr, "navcal log: {} is there already\n", log.name);
  }
}

void order_log(const LogControlOptions& options, const char* command) {
  LogLink link(options.control);
  link.ask({{"command", command}});
}

void select_log(const LogControlOptions& options) {
  LogLink link(options.control);
  nlohmann::json request{{"command", "log.select"}};
  if (options.everything || !options.leave_out.empty()) request["leave_out"] = options.leave_out;
  for (const auto& left_out : link.ask(request).value("leave_out", nlohmann::json::array()))
    fmt::print("{}\n", base::printable(left_out.get<std::string>()));
}

CLI::App* add_command(CLI::App& log, const LogOptions& options, const char* name, const char* description,
                      const char* example) {
  auto* const command = log.add_subcommand(name, description);
  add_valued(command, "--control", "SOCKET [/run/navcal/control]", options->control, "navcald's control socket");
  command->footer(std::string("Example: ") + example);
  return command;
}

}  // namespace

void add_log_control(CLI::App& log) {
  const auto options = std::make_shared<LogControlOptions>();
  auto* const list = add_command(log, options, "list", "the logs of a running navcald: name, bytes, begin, end",
                                 "navcal log list");
  list->add_flag("--json", options->json, "one JSON array instead of text");
  list->callback([options] { show_logs(*options); });

  auto* const fetch = add_command(log, options, "fetch", "downloads finished logs from a running navcald",
                                  "navcal log fetch --to dives");
  add_valued(fetch, "FILE", "NAME", options->files,
             "names of logs; without any, all that are finished and not there yet");
  add_valued(fetch, "--to", "DIR", options->to, "folder for the logs")->required();
  fetch->footer(
      "NAME.part grows in the folder, and the same command continues it after an interruption. Checksums are\n"
      "compared, and a file that is there is never overwritten.\n\nExample: navcal log fetch --to dives");
  fetch->callback([options] { fetch_logs(*options); });

  add_command(log, options, "start", "begins a new log file after navcal log stop", "navcal log start")
      ->callback([options] { order_log(*options, "log.start"); });
  add_command(log, options, "stop",
              "ends the log file; navcald runs on without a log until log start or a restart", "navcal log stop")
      ->callback([options] { order_log(*options, "log.stop"); });

  auto* const select = add_command(log, options, "select", "what the log of a running navcald leaves out",
                                   "navcal log select --leave-out raw.gps --leave-out navigation");
  auto* const leave_out =
      select->add_option("--leave-out", options->leave_out,
                         "samples, navigation, health, calibration, commands, raw or raw.PORT; may be repeated");
  leave_out->option_text("PART")->take_all()->allow_extra_args(false);
  select->add_flag("--everything", options->everything, "nothing is left out")->excludes(leave_out);
  select->callback([options] { select_log(*options); });
}

}  // namespace navcal::cli
