// SPDX-License-Identifier: Apache-2.0
#include "daemon/log_answers.h"

#include <fmt/format.h>

#include "daemon/json_text.h"
#include "record/json/base64.h"
#include "record/log/log_shelf.h"

namespace navcal::daemon {
namespace {

std::string list_answer(const std::filesystem::path& folder, const ControlRequest& request) {
  const auto page = record::list_logs(folder, request.file, request.length);
  if (page.error) return control_error("the log folder cannot be read: " + page.error.message());
  std::string out = "{\"ok\":true,\"files\":[";
  for (const auto& log : page.logs) {
    if (&log != &page.logs.front()) out += ',';
    out += "{\"name\":";
    append_quoted(out, log.name);
    out += fmt::format(",\"bytes\":{},\"finished\":{},\"begin\":", log.bytes, log.finished);
    log.span ? append_utc(out, log.span->begin_ns, 3) : void(out += "null");
    out += ",\"end\":";
    log.span ? append_utc(out, log.span->end_ns, 3) : void(out += "null");
    out += '}';
  }
  return out + fmt::format("],\"more\":{}}}\n", page.more);
}

}  // namespace

std::string answer_from_disk(const std::filesystem::path& folder, const ControlRequest& request) {
  if (request.command == ControlCommand::log_list) return list_answer(folder, request);
  const bool is_sum = request.command == ControlCommand::log_sum;
  const auto read =
      (is_sum ? record::sum_log : record::read_log)(folder, request.file, request.offset, request.length);
  if (const auto* problem = std::get_if<std::string>(&read)) return control_error(*problem);
  const auto& part = std::get<record::LogPart>(read);
  std::string out = fmt::format("{{\"ok\":true,\"offset\":{},\"length\":{},\"size\":{},\"crc32\":{}", part.offset,
                                part.length, part.size, part.crc32);
  if (!is_sum) out += ",\"data\":\"" + record::base64(part.bytes) + '"';
  return out + "}\n";
}

}  // namespace navcal::daemon
