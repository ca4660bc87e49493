// SPDX-License-Identifier: Apache-2.0
#include "cli/remote_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/failure.h"
#include "record/json/base64.h"
#include "record/log/checksum.h"

namespace navcal::cli {
namespace {

using RemoteJson = nlohmann::json;

/// Bytes asked for at once: ten seconds on a link of 2 kB/s.
constexpr std::uint64_t kRemotePart_bytes = 12288;
/// Bytes whose checksum the vehicle gives at once.
constexpr std::uint64_t kRemoteSum_bytes = 4 << 20;
/// Time for which an answer is awaited on a link that may be dead for a while.
constexpr double kRemotePatience_s = 600;

[[noreturn]] void fail_remote(const std::string& why) { throw analysis::Failure(analysis::Exit::failed, why); }

RemoteJson granted(RemoteOperator& remote, const RemoteJson& request) {
  RemoteJson answer = RemoteJson::parse(remote.ask(request.dump(), kRemotePatience_s), nullptr, false);
  if (!answer.is_object()) fail_remote("the vehicle's answer is no JSON object");
  if (answer.value("ok", false)) return answer;
  fail_remote("navcald: " + answer.value("error", std::string("refused")));
}

struct VehicleLog {
  std::string name;
  std::uint64_t bytes = 0;
};

std::vector<VehicleLog> logs_of(RemoteOperator& remote) {
  std::vector<VehicleLog> logs;
  for (bool more = true; more;) {
    const RemoteJson page =
        granted(remote, {{"command", "log.list"}, {"after", logs.empty() ? "" : logs.back().name}});
    for (const RemoteJson& log : page.at("files")) logs.push_back({log.at("name"), log.at("bytes")});
    more = page.value("more", false) && !page.at("files").empty();
  }
  return logs;
}

std::uint32_t sum_of_file(const std::filesystem::path& file, std::uint64_t offset, std::uint64_t length) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(offset));
  std::string bytes(length, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(length));
  if (static_cast<std::uint64_t>(in.gcount()) != length) fail_remote(file.string() + ": cannot be read");
  return record::crc32(bytes);
}

/// Compares `bytes` bytes of a file with those of the log, by checksums that the vehicle makes.
bool is_same(RemoteOperator& remote, const std::string& name, const std::filesystem::path& file,
             std::uint64_t bytes) {
  for (std::uint64_t offset = 0; offset < bytes;) {
    const std::uint64_t length = std::min(kRemoteSum_bytes, bytes - offset);
    const RemoteJson sum =
        granted(remote, {{"command", "log.sum"}, {"file", name}, {"offset", offset}, {"length", length}});
    if (sum.at("length") != length || sum.at("crc32") != sum_of_file(file, offset, length)) return false;
    offset += length;
  }
  return true;
}

void append_part(RemoteOperator& remote, const std::string& name, const std::filesystem::path& part,
                 std::uint64_t offset) {
  const RemoteJson answer = granted(
      remote, {{"command", "log.read"}, {"file", name}, {"offset", offset}, {"length", kRemotePart_bytes}});
  const auto bytes = record::from_base64(answer.at("data").get<std::string>());
  if (!bytes || bytes->empty() || answer.value("crc32", record::crc32(*bytes)) != record::crc32(*bytes))
    fail_remote(name + ": a part is damaged, or the log has become shorter");
  std::ofstream out(part, std::ios::binary | std::ios::app);
  out.write(bytes->data(), static_cast<std::streamsize>(bytes->size()));
  out.close();
  if (!out) fail_remote(part.string() + ": cannot be written");
}

}  // namespace

std::string list_files(RemoteOperator& remote) {
  try {
    std::string out;
    for (const VehicleLog& log : logs_of(remote)) out += fmt::format("{:>12}  {}\n", log.bytes, log.name);
    return out;
  } catch (const RemoteJson::exception& error) {
    fail_remote(std::string("the vehicle's list of logs cannot be read: ") + error.what());
  }
}

void get_file(RemoteOperator& remote, const std::string& name, const std::filesystem::path& target) {
  try {
    const auto logs = logs_of(remote);
    const auto found =
        std::find_if(logs.begin(), logs.end(), [&](const VehicleLog& log) { return log.name == name; });
    if (found == logs.end())
      throw analysis::Failure(analysis::Exit::bad_input, name + ": the vehicle has no such log");
    if (name.find('/') != std::string::npos) fail_remote(name + ": not the name of a log");
    if (std::filesystem::exists(target)) fail_remote(target.string() + ": is there already");
    const std::filesystem::path part = target.string() + ".part";
    std::error_code error;
    std::uint64_t bytes = std::filesystem::file_size(part, error);
    if (error) bytes = 0;
    if (bytes > found->bytes || (bytes > 0 && !is_same(remote, name, part, bytes))) {
      fmt::print(stderr, "navcal remote: {} belongs to another log, and begins anew\n", part.string());
      std::filesystem::remove(part);
      bytes = 0;
    }
    while (bytes < found->bytes) {
      append_part(remote, name, part, bytes);
      bytes = std::filesystem::file_size(part);
      fmt::print(stderr, "\rnavcal remote: {} of {} bytes", bytes, found->bytes);
    }
    fmt::print(stderr, "\n");
    if (found->bytes == 0) std::ofstream(part).close();
    if (bytes > found->bytes) std::filesystem::resize_file(part, found->bytes);
    if (!is_same(remote, name, part, found->bytes)) fail_remote(part.string() + ": the checksum is wrong");
    std::filesystem::rename(part, target);
  } catch (const RemoteJson::exception& error) {
    fail_remote(name + ": the vehicle's answer cannot be read: " + error.what());
  }
}

}  // namespace navcal::cli
