// SPDX-License-Identifier: Apache-2.0
#include "cli/log_link.h"

#include <nlohmann/json.hpp>

#include "analysis/failure.h"
#include "record/json/base64.h"
#include "record/log/checksum.h"

namespace navcal::cli {
namespace {

/// The answer is a line of a third more.
constexpr std::uint64_t kLogPart_bytes = 49152;

[[noreturn]] void fail_log(const std::string& why) { throw analysis::Failure(analysis::Exit::failed, why); }

std::string text_or_nothing(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : "";
}

}  // namespace

std::vector<RemoteLog> LogLink::list() {
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

std::string LogLink::read(const std::string& name, std::uint64_t offset) {
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

std::uint32_t LogLink::sum(const std::string& name, std::uint64_t offset, std::uint64_t length) {
  try {
    const auto part = ask({{"command", "log.sum"}, {"file", name}, {"offset", offset}, {"length", length}});
    if (part.at("length") != length) fail_log(name + ": it is shorter than navcald has said");
    return part.at("crc32").get<std::uint32_t>();
  } catch (const nlohmann::json::exception& error) {
    fail_log(name + ": navcald's answer cannot be read: " + error.what());
  }
}

}  // namespace navcal::cli
