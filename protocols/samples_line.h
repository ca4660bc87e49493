// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// Lines of injected samples (ICD, "Injected samples"): one flat JSON object a line, `{...}<LF>` or
/// `{...}<CR><LF>`. A flat object holds numbers, texts, true, false, null, and lists of them; it holds no object.
namespace navcal::protocols::samples_line {

inline constexpr std::size_t kMaxLength = 2048;  ///< of a line, all bytes counted

/// Name of a frame: its class where the line begins with it ({"class":"IMU",...), else "SAMPLE".
/// A line without `}` before its end counts as a bad checksum. The bytes `{"` begin the next line, wherever they
/// are found, so that a line that was cut costs no other.
struct Scanner : StartsWith<'{'> {
  static constexpr std::size_t kMaxFrameLength = kMaxLength;
  [[nodiscard]] static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};

using Parser = StreamParser<Scanner>;

enum class Kind : std::uint8_t { number, text, boolean, null, list, nested };

struct Member {
  std::string_view key;    ///< between its quotes, escapes as they are written
  std::string_view value;  ///< as it is written; a text and a list without quotes and brackets, unless nested
  Kind kind = Kind::null;
};

/// The members of one line. Points into the line.
class Object {
 public:
  static constexpr std::size_t kMostMembers = 64;

  /// nullopt when the line is not one flat JSON object (RFC 8259), or has more than kMostMembers. With `nested`,
  /// lists and objects may be members, of which brackets and texts are looked at alone.
  [[nodiscard]] static std::optional<Object> parse(Bytes line, bool nested = false);

  /// The first member of this name; nullptr when there is none.
  [[nodiscard]] const Member* find(std::string_view key) const;
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] const Member& operator[](std::size_t i) const { return members_[i]; }

 private:
  std::array<Member, kMostMembers> members_{};
  std::size_t count_ = 0;
};

struct Bounds {
  double min = 0, max = 0;
};

/// Reads members by name, type and range. A member that is absent or null gives nullopt. One of another type, or
/// out of its range, gives nullopt too and makes all_good() false.
class Fields {
 public:
  explicit Fields(const Object& object) : object_(object) {}

  [[nodiscard]] std::optional<double> number(std::string_view key, Bounds bounds);
  [[nodiscard]] std::optional<std::uint32_t> integer(std::string_view key, std::uint32_t max);
  /// A list of three numbers.
  [[nodiscard]] std::optional<std::array<double, 3>> vector(std::string_view key, Bounds bounds);
  /// A list of three, each a number or null.
  [[nodiscard]] std::array<std::optional<double>, 3> three(std::string_view key, Bounds bounds);
  [[nodiscard]] std::optional<bool> boolean(std::string_view key);
  /// The text with its escapes resolved, in UTF-8.
  [[nodiscard]] std::optional<std::string> text(std::string_view key);
  /// Seconds in plain decimals, not negative, below 9e9; digits beyond the ninth decimal are dropped.
  [[nodiscard]] std::optional<std::int64_t> nanoseconds(std::string_view key);

  void refuse() { all_good_ = false; }
  [[nodiscard]] bool all_good() const { return all_good_; }

 private:
  [[nodiscard]] const Member* find(std::string_view key, Kind kind);
  template <class T>
  std::optional<T> refused() {
    refuse();
    return std::nullopt;
  }

  const Object& object_;
  bool all_good_ = true;
};

/// Writes one line. Members come in the order of the calls; a number that is not finite is left out.
class LineWriter {
 public:
  explicit LineWriter(std::string_view class_name);
  LineWriter& seconds(std::string_view key, std::int64_t ns);
  LineWriter& number(std::string_view key, double value);
  LineWriter& number(std::string_view key, const std::optional<double>& value);
  LineWriter& vector(std::string_view key, const std::array<double, 3>& values);
  /// A list in which an absent value, and one that is not finite, is null.
  LineWriter& three(std::string_view key, const std::array<std::optional<double>, 3>& values);
  /// Bytes that are no UTF-8 become U+FFFD.
  LineWriter& text(std::string_view key, std::string_view value);
  LineWriter& boolean(std::string_view key, bool value);
  /// The whole line with its end. The writer is empty afterwards.
  [[nodiscard]] std::string finish();

 private:
  void begin(std::string_view key);
  std::string line_;
};

}  // namespace navcal::protocols::samples_line
