// SPDX-License-Identifier: Apache-2.0
#include "daemon/request.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace navcal::daemon {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kSpace = " \t\r\n";
/// Number of characters of a bad request that the answer repeats.
constexpr std::size_t kQuoted = 80;

std::string_view trim(std::string_view text) {
  const auto begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

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
  return trim(command);
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

/// ["STATE","TPV"]; null: the usual ones. Why it is neither; empty: taken.
std::string take_classes(const Json& object, std::optional<ReportClasses>& value) {
  const auto found = object.find("classes");
  if (found == object.end()) return {};
  if (found->is_null()) value = ReportClasses::usual();
  if (found->is_null()) return {};
  if (!found->is_array()) return "Invalid WATCH: classes is a list of classes, or null";
  ReportClasses classes;
  for (const Json& name : *found) {
    const auto report = name.is_string() ? report_class_named(name.get<std::string>()) : std::nullopt;
    if (!report)
      return fmt::format("Invalid WATCH: a class that is not known; known are {}", known_report_classes());
    classes.add(*report);
  }
  value = classes;
  return {};
}

/// 2; null: the usual one. Likewise.
std::string take_nmea_rate(const Json& object, std::optional<std::int64_t>& value) {
  const auto found = object.find("nmea_rate_Hz");
  if (found == object.end()) return {};
  if (found->is_null()) value = kNmeaInterval_ns;
  if (found->is_null()) return {};
  const double rate_Hz = found->is_number() ? found->get<double>() : 0;
  if (!(rate_Hz >= kMinReportRate_Hz && rate_Hz <= kMaxReportRate_Hz))
    return fmt::format("Invalid WATCH: nmea_rate_Hz is {} to {} Hz, or null", kMinReportRate_Hz,
                       kMaxReportRate_Hz);
  value = std::llround(1e9 / rate_Hz);
  return {};
}

/// ["/compass","/imu"]; null: all. Likewise.
std::string take_topics(const Json& object, std::optional<RecordTopics>& value) {
  const auto found = object.find("topics");
  if (found == object.end()) return {};
  if (found->is_null()) value = RecordTopics::all();
  if (found->is_null()) return {};
  if (!found->is_array()) return "Invalid WATCH: topics is a list of topics, or null";
  RecordTopics topics;
  for (const Json& name : *found) {
    if (!name.is_string() || !topics.add(name.get<std::string>()))
      return fmt::format("Invalid WATCH: a topic that is not known; known are {}", RecordTopics::all().text());
  }
  value = topics;
  return {};
}

/// {"/imu":5,"/gps":null}: null is every record; null in place of the object: none is chosen. Likewise.
std::string take_topic_rates(const Json& object, std::optional<RecordIntervals>& value) {
  const auto found = object.find("topic_rate_Hz");
  if (found == object.end()) return {};
  if (!found->is_null() && !found->is_object()) return "Invalid WATCH: topic_rate_Hz is an object, or null";
  RecordIntervals intervals_ns;
  for (const auto& [name, rate] : found->items()) {
    const double rate_Hz = rate.is_number() ? rate.get<double>() : 0;
    if (!rate.is_null() && !(rate_Hz >= kMinReportRate_Hz && rate_Hz <= kMaxReportRate_Hz))
      return fmt::format("Invalid WATCH: the rate of a topic is {} to {} Hz, or null", kMinReportRate_Hz,
                         kMaxReportRate_Hz);
    if (!intervals_ns.set(name, rate.is_null() ? 0 : std::llround(1e9 / rate_Hz)))
      return fmt::format("Invalid WATCH: a topic that is not known; known are {}", RecordTopics::all().text());
  }
  value = intervals_ns;
  return {};
}

/// {"STATE":10}; null: no limits. Likewise.
std::string take_intervals(const Json& object, std::optional<ReportIntervals>& value) {
  const auto found = object.find("rate_Hz");
  if (found == object.end()) return {};
  ReportIntervals intervals_ns{};
  if (!found->is_null() && !found->is_object()) return "Invalid WATCH: rate_Hz is an object, or null";
  for (const auto& [name, rate] : found->items()) {
    const auto report = report_class_named(name);
    if (!report)
      return fmt::format("Invalid WATCH: a class that is not known; known are {}", known_report_classes());
    const double rate_Hz = rate.is_number() ? rate.get<double>() : 0;
    if (!(rate_Hz >= kMinReportRate_Hz && rate_Hz <= kMaxReportRate_Hz))
      return fmt::format("Invalid WATCH: a rate is {} to {} Hz", kMinReportRate_Hz, kMaxReportRate_Hz);
    intervals_ns.at(static_cast<std::size_t>(*report)) = std::llround(1e9 / rate_Hz);
  }
  value = intervals_ns;
  return {};
}

Request watch(const Json& object) {
  WatchChange change;
  std::optional<bool> enable;
  if (!take(object, "enable", enable)) return not_understood("Invalid WATCH: enable is true or false");
  if (!take(object, "json", change.json)) return not_understood("Invalid WATCH: json is true or false");
  if (!take(object, "nmea", change.nmea)) return not_understood("Invalid WATCH: nmea is true or false");
  if (!take(object, "device", change.device)) return not_understood("Invalid WATCH: device is a string");
  if (auto problem = take_classes(object, change.classes); !problem.empty()) return not_understood(problem);
  if (auto problem = take_intervals(object, change.intervals_ns); !problem.empty()) return not_understood(problem);
  if (auto problem = take_nmea_rate(object, change.nmea_interval_ns); !problem.empty())
    return not_understood(problem);
  if (auto problem = take_topics(object, change.topics); !problem.empty()) return not_understood(problem);
  if (auto problem = take_topic_rates(object, change.topic_intervals_ns); !problem.empty())
    return not_understood(problem);
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
  const std::string_view name = trim(command.substr(1, equals == std::string_view::npos ? equals : equals - 1));
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
