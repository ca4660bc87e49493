// SPDX-License-Identifier: Apache-2.0
#include "daemon/request.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/line_reader.h"

namespace navcal::daemon {
namespace {

using Json = nlohmann::json;

/// Number of characters of a bad request that the answer repeats.
constexpr std::size_t kQuoted = 80;

/// Follows braces and strings, so that a semicolon inside of JSON ends no command.
class Nesting {
 public:
  void see(char c) {
    if (in_string_) {
      if (escaped_) {
        escaped_ = false;
      } else if (c == '\\') {
        escaped_ = true;
      } else if (c == '"') {
        in_string_ = false;
      }
      return;
    }
    if (c == '"') in_string_ = true;
    if (c == '{') ++depth_;
    if (c == '}' && depth_ > 0) --depth_;
  }
  [[nodiscard]] bool outside() const { return depth_ == 0 && !in_string_; }

 private:
  int depth_ = 0;
  bool in_string_ = false;
  bool escaped_ = false;
};

/// Length of the command at the beginning of `text`, with the semicolon or the closing brace that ends it; 0 when
/// it is not complete.
std::size_t command_length(std::string_view text) {
  Nesting nesting;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ';' && nesting.outside()) return i + 1;
    const bool inside = !nesting.outside();
    nesting.see(text[i]);
    if (inside && text[i] == '}' && nesting.outside()) return i + 1;
  }
  return 0;
}

/// Takes the next command, without its semicolon, off `line`.
std::string_view take_command(std::string_view& line) {
  const std::size_t length = command_length(line);
  std::string_view command = line.substr(0, length == 0 ? line.size() : length);
  line.remove_prefix(command.size());
  if (length > 0 && command.back() == ';') command.remove_suffix(1);
  return base::trimmed(command);
}

Request not_understood(std::string message) {
  Request request;
  request.message = std::move(message);
  return request;
}

Request unrecognised(std::string_view command) {
  const bool cut = command.size() > kQuoted;
  return not_understood(fmt::format("Unrecognized request '{}{}'", command.substr(0, kQuoted), cut ? "..." : ""));
}

/// The value of `key`, if it is there and of type T; an error message when it is of another type.
template <class T>
bool take(const Json& object, const char* key, std::optional<T>& value) {
  const auto found = object.find(key);
  if (found == object.end()) return true;
  if constexpr (std::is_same_v<T, bool>) {
    if (!found->is_boolean()) return false;
  } else {
    if (!found->is_string()) return false;
  }
  value = found->template get<T>();
  return true;
}

/// Why a member of WATCH cannot be taken, for people; empty: it was.
using WatchProblem = std::string;

/// Interval of a rate; nullopt when it is none.
std::optional<std::int64_t> interval_of(const Json& rate) {
  const double rate_Hz = rate.is_number() ? rate.get<double>() : 0;
  if (!(rate_Hz >= kMinReportRate_Hz && rate_Hz <= kMaxReportRate_Hz)) return std::nullopt;
  return std::llround(1e9 / rate_Hz);
}

WatchProblem bad_rate(std::string_view what, std::string_view or_null = {}) {
  return fmt::format("Invalid WATCH: {} {} to {} Hz{}", what, kMinReportRate_Hz, kMaxReportRate_Hz, or_null);
}

WatchProblem unknown_class() {
  return fmt::format("Invalid WATCH: a class that is not known; known are {}", known_report_classes());
}

WatchProblem unknown_topic() {
  return fmt::format("Invalid WATCH: a topic that is not known; known are {}", RecordTopics::all().text());
}

/// The member at `key`, with `take(member, chosen)`; null is the choice `usual`.
template <class Choice, class Take>
WatchProblem take_choice(const Json& object, const char* key, const Choice& usual, std::optional<Choice>& value,
                         Take take) {
  const auto found = object.find(key);
  if (found == object.end()) return {};
  if (found->is_null()) {
    value = usual;
    return {};
  }
  Choice chosen{};
  if (WatchProblem problem = take(*found, chosen); !problem.empty()) return problem;
  value = chosen;
  return {};
}

/// ["STATE","TPV"]
WatchProblem read_classes(const Json& list, ReportClasses& classes) {
  if (!list.is_array()) return "Invalid WATCH: classes is a list of classes, or null";
  for (const Json& name : list) {
    const auto report = name.is_string() ? report_class_named(name.get<std::string>()) : std::nullopt;
    if (!report) return unknown_class();
    classes.add(*report);
  }
  return {};
}

/// {"STATE":10}
WatchProblem read_intervals(const Json& rates, ReportIntervals& intervals_ns) {
  if (!rates.is_object()) return "Invalid WATCH: rate_Hz is an object, or null";
  for (const auto& [name, rate] : rates.items()) {
    const auto report = report_class_named(name);
    if (!report) return unknown_class();
    const auto every_ns = interval_of(rate);
    if (!every_ns) return bad_rate("a rate is");
    intervals_ns.at(static_cast<std::size_t>(*report)) = *every_ns;
  }
  return {};
}

/// 2
WatchProblem read_nmea_rate(const Json& rate, std::int64_t& nmea_interval_ns) {
  const auto every_ns = interval_of(rate);
  if (!every_ns) return bad_rate("nmea_rate_Hz is", ", or null");
  nmea_interval_ns = *every_ns;
  return {};
}

/// ["/compass","/imu"]
WatchProblem read_topics(const Json& list, RecordTopics& topics) {
  if (!list.is_array()) return "Invalid WATCH: topics is a list of topics, or null";
  for (const Json& name : list) {
    if (!name.is_string() || !topics.add(name.get<std::string>())) return unknown_topic();
  }
  return {};
}

/// {"/imu":5,"/gps":null}: null is every record.
WatchProblem read_topic_rates(const Json& rates, RecordIntervals& intervals_ns) {
  if (!rates.is_object()) return "Invalid WATCH: topic_rate_Hz is an object, or null";
  for (const auto& [name, rate] : rates.items()) {
    const auto every_ns = rate.is_null() ? std::optional<std::int64_t>(0) : interval_of(rate);
    if (!every_ns) return bad_rate("the rate of a topic is", ", or null");
    if (!intervals_ns.set(name, *every_ns)) return unknown_topic();
  }
  return {};
}

Request watch(const Json& object) {
  WatchChange change;
  std::optional<bool> enable;
  if (!take(object, "enable", enable)) return not_understood("Invalid WATCH: enable is true or false");
  if (!take(object, "json", change.json)) return not_understood("Invalid WATCH: json is true or false");
  if (!take(object, "nmea", change.nmea)) return not_understood("Invalid WATCH: nmea is true or false");
  if (!take(object, "device", change.device)) return not_understood("Invalid WATCH: device is a string");
  WatchProblem problem;
  const auto is_bad = [&](WatchProblem found) { return !(problem = std::move(found)).empty(); };
  if (is_bad(take_choice(object, "classes", ReportClasses::usual(), change.classes, read_classes)) ||
      is_bad(take_choice(object, "rate_Hz", ReportIntervals{}, change.intervals_ns, read_intervals)) ||
      is_bad(take_choice(object, "nmea_rate_Hz", kNmeaInterval_ns, change.nmea_interval_ns, read_nmea_rate)) ||
      is_bad(take_choice(object, "topics", RecordTopics::all(), change.topics, read_topics)) ||
      is_bad(take_choice(object, "topic_rate_Hz", RecordIntervals{}, change.topic_intervals_ns, read_topic_rates)))
    return not_understood(std::move(problem));
  change.enable = enable.value_or(true);
  Request request;
  request.kind = Request::Kind::watch;
  request.watch = std::move(change);
  return request;
}

Request device(const Json& object) {
  Request request;
  request.kind = Request::Kind::device;
  if (!take(object, "path", request.device)) return not_understood("Invalid DEVICE: path is a string");
  for (const char* key : {"bps", "cycle", "native", "parity", "stopbits", "hexdata"}) {
    if (object.contains(key))
      return not_understood(fmt::format("DEVICE: {} is set by the configuration only", key));
  }
  return request;
}

Request parse(std::string_view command) {
  if (command.empty() || command.front() != '?') return unrecognised(command);
  const auto equals = command.find('=');
  const std::string_view name =
      base::trimmed(command.substr(1, equals == std::string_view::npos ? equals : equals - 1));
  Request request;
  if (equals == std::string_view::npos) {
    using Kind = Request::Kind;
    for (const auto& [kind, text] : {std::pair{Kind::version, "VERSION"}, std::pair{Kind::devices, "DEVICES"},
                                     std::pair{Kind::device, "DEVICE"}, std::pair{Kind::watch, "WATCH"},
                                     std::pair{Kind::poll, "POLL"}, std::pair{Kind::records, "RECORDS"}}) {
      if (name == text) request.kind = kind;
    }
    return request.kind == Kind::not_understood ? unrecognised(command) : request;
  }
  if (name != "WATCH" && name != "DEVICE") return unrecognised(command);
  const Json object = Json::parse(command.substr(equals + 1), nullptr, false);
  if (!object.is_object()) return not_understood(fmt::format("Invalid {}: not a JSON object", name));
  return name == "WATCH" ? watch(object) : device(object);
}

}  // namespace

std::vector<Request> parse_requests(std::string_view line) {
  std::vector<Request> requests;
  while (!line.empty()) {
    const std::string_view command = take_command(line);
    if (!command.empty()) requests.push_back(parse(command));
  }
  return requests;
}

std::size_t complete_length(std::string_view text) {
  std::size_t complete = 0;
  while (const std::size_t length = command_length(text.substr(complete))) complete += length;
  return complete;
}

}  // namespace navcal::daemon
