// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/units.h"
#include "config/value.h"
#include "protocols/frame.h"

namespace navcal::config {

enum class Kind : std::uint8_t { boolean, integer, real, text, choice, channels, list };

/// Description of one setting. The checks, the shipped file and the page in docs/ are made from it.
struct OptionInfo {
  std::string_view table{};  ///< "log"; of a port: "", "units", "channels", "fix", "mounting"
  std::string_view key{};
  std::string_view description{};
  Kind kind = Kind::text;
  Unit unit = kNoUnit;  ///< of the number in the file
  double low = 0;       ///< least and greatest number allowed, in that unit
  double high = 0;
  bool zero_allowed = true;
  bool octal = false;                              ///< as file modes are written
  std::size_t count = 0;                           ///< of the numbers of `channels`: eight or three
  std::vector<std::string_view> choices{};         ///< in the order of the enumeration's values
  std::string_view text_rule{};                    ///< what a text (of a list: each) must be, in words ...
  bool (*text_holds)(std::string_view) = nullptr;  ///< ... and in code
  std::vector<protocols::Protocol> only_for{};     ///< empty: every port
  /// Another option that sets the same member: this key is still read, and no longer written. Empty: it is the
  /// only one.
  std::string_view moved_to{};

  [[nodiscard]] std::string name() const;
  /// "0.01 to 60 s", "true or false", "deg, mils or counts16".
  [[nodiscard]] std::string allowed() const;
  [[nodiscard]] bool is_textual() const { return kind == Kind::text || kind == Kind::choice; }
  [[nodiscard]] bool applies_to(protocols::Protocol protocol) const;
  /// Converts a value to the option's own kind; whole numbers pass for reals. Returns why the value cannot be
  /// taken, or nullopt after the conversion.
  [[nodiscard]] std::optional<std::string> adopt(Value& value) const;
  /// The value as text in the form of the file.
  [[nodiscard]] std::string write(const Value& value) const;
};

/// One setting of an Owner (Settings or PortSettings) with the way to and from
/// its member.
template <class Owner>
struct Option : OptionInfo {
  std::function<Value(const Owner&)> get;
  /// Takes what adopt() has accepted.
  std::function<void(Owner&, const Value&)> set;
};

/// Purpose of an option, or of a table for an empty key, by option_texts.txt. Throws std::out_of_range without
/// one.
[[nodiscard]] std::string_view option_text(std::string_view table, std::string_view key = {});

/// Name of the table without a name in option_texts.txt.
template <class Owner>
inline constexpr std::string_view kUntitled{};

/// Makes the options of one table. Each maker takes the key, the member and its bounds.
template <class Owner, class Part>
struct TableOf {
  std::string_view table;
  Part part;  ///< of the owner, in which the members lie: a pointer to a member or a function
  std::vector<protocols::Protocol> only_for{};

  template <class Member>
  Option<Owner> boolean(std::string_view key, Member member) const {
    return plain<bool>({.key = key, .kind = Kind::boolean}, member);
  }

  template <class Member>
  Option<Owner> integer(std::string_view key, Member member, const Unit& unit, double low, double high) const {
    return make(
        {.key = key, .kind = Kind::integer, .unit = unit, .low = low, .high = high}, member,
        [](const auto& field) { return Value(std::int64_t{field}); },
        [](auto& field, const Value& value) {
          field = static_cast<std::remove_reference_t<decltype(field)>>(std::get<std::int64_t>(value));
        });
  }

  /// `low` and `high` are in `unit`.
  template <class Member>
  Option<Owner> number(std::string_view key, Member member, const Unit& unit, double low, double high) const {
    return make(
        {.key = key, .kind = Kind::real, .unit = unit, .low = low, .high = high}, member,
        [unit](const auto& field) { return Value(to_file(field, unit)); },
        [unit](auto& field, const Value& value) {
          field = to_inside<std::remove_reference_t<decltype(field)>>(std::get<double>(value), unit);
        });
  }

  /// A text or a path; `rule` says in words what `holds` checks.
  template <class Member>
  Option<Owner> text(std::string_view key, Member member, bool (*holds)(std::string_view),
                     std::string_view rule) const {
    return plain<std::string>({.key = key, .text_rule = rule, .text_holds = holds}, member);
  }

  /// A list of texts, which may be empty; likewise of each.
  template <class Member>
  Option<Owner> list(std::string_view key, Member member, bool (*holds)(std::string_view),
                     std::string_view rule) const {
    return plain<std::vector<std::string>>(
        {.key = key, .kind = Kind::list, .text_rule = rule, .text_holds = holds}, member);
  }

  template <class Member>
  Option<Owner> choice(std::string_view key, Member member, const std::vector<std::string_view>& choices) const {
    return make(
        {.key = key, .kind = Kind::choice, .choices = choices}, member,
        [choices](const auto& field) { return Value(std::string(choices.at(static_cast<std::size_t>(field)))); },
        [choices](auto& field, const Value& value) {
          const auto chosen = std::find(choices.begin(), choices.end(), std::get<std::string>(value));
          field = static_cast<std::remove_reference_t<decltype(field)>>(chosen - choices.begin());
        });
  }

  /// The numbers of an array.
  template <class Member>
  Option<Owner> channels(std::string_view key, Member member, const Unit& unit, double low, double high) const {
    auto option = make(
        {.key = key, .kind = Kind::channels, .unit = unit, .low = low, .high = high}, member,
        [](const auto& field) { return Value(std::vector<double>(field.begin(), field.end())); },
        [](auto& field, const Value& value) {
          const auto& given = std::get<std::vector<double>>(value);
          std::copy(given.begin(), given.end(), field.begin());
        });
    using Numbers = decltype(std::invoke(member, std::invoke(part, std::declval<Owner&>())));
    option.count = std::tuple_size_v<std::remove_reference_t<Numbers>>;
    return option;
  }

 private:
  template <class Member>
  Option<Owner> make(OptionInfo info, Member member, auto read, auto write) const {
    info.table = table;
    info.description = option_text(table.empty() ? kUntitled<Owner> : table, info.key);
    info.only_for = only_for;
    const auto field = [ part = part, member ](auto& owner) -> auto& {
      return std::invoke(member, std::invoke(part, owner));
    };
    return {std::move(info), [field, read](const Owner& owner) { return read(field(owner)); },
            [field, write](Owner& owner, const Value& value) { write(field(owner), value); }};
  }

  /// A member that the file has as it is.
  template <class Type, class Member>
  Option<Owner> plain(OptionInfo info, Member member) const {
    return make(
        std::move(info), member, [](const auto& field) { return Value(Type(field)); },
        [](auto& field, const Value& value) { field = std::get<Type>(value); });
  }
};

template <class Owner, class Part>
TableOf<Owner, Part> table_of(std::string_view table, Part part, std::vector<protocols::Protocol> only_for = {}) {
  return {table, part, std::move(only_for)};
}

}  // namespace navcal::config
