// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::record {

/// Seconds with nine decimals, from integers: a double would lose the last hundred nanoseconds of a UTC time.
void append_seconds(std::string& out, std::int64_t ns);

/// Appends one JSON object member by member to text that somebody else keeps. Keys must need no escaping.
class JsonObject {
 public:
  JsonObject(std::string& out, std::string_view class_name);
  JsonObject(const JsonObject&) = delete;
  JsonObject& operator=(const JsonObject&) = delete;
  ~JsonObject() { out_ += '}'; }

  void seconds(std::string_view key, std::int64_t ns);
  /// The shortest decimal that reads back as the same double; null when it is not finite.
  void number(std::string_view key, double value);
  void number(std::string_view key, const std::optional<double>& value);
  void numbers(std::string_view key, const std::array<double, 3>& values);
  void numbers(std::string_view key, const std::array<std::optional<double>, 3>& values);
  void integer(std::string_view key, std::int64_t value);
  void boolean(std::string_view key, bool value);
  /// Any bytes; what is not UTF-8 becomes U+FFFD.
  void text(std::string_view key, std::string_view value);
  void null(std::string_view key);
  /// `json` is a whole value.
  void raw(std::string_view key, std::string_view json);

 private:
  void begin(std::string_view key);

  std::string& out_;
};

}  // namespace navcal::record
