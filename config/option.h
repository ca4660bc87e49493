// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
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
  std::size_t count = 8;                           ///< of the numbers of `channels`: eight or three
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

// Each maker below takes the description and a function that returns the
// member: [](auto& s) -> auto& { return s.x; }.

template <class Owner, class Member>
Option<Owner> boolean(OptionInfo info, Member member) {
  info.kind = Kind::boolean;
  return {std::move(info), [member](const Owner& owner) { return Value(member(owner)); },
          [member](Owner& owner, const Value& value) { member(owner) = std::get<bool>(value); }};
}

template <class Owner, class Member>
Option<Owner> integer(OptionInfo info, Member member) {
  using Field = std::remove_cvref_t<decltype(member(std::declval<Owner&>()))>;
  info.kind = Kind::integer;
  return {std::move(info), [member](const Owner& owner) { return Value(std::int64_t{member(owner)}); },
          [member](Owner& owner, const Value& value) {
            member(owner) = static_cast<Field>(std::get<std::int64_t>(value));
          }};
}

template <class Owner, class Member>
Option<Owner> real(OptionInfo info, Member member) {
  using Field = std::remove_cvref_t<decltype(member(std::declval<Owner&>()))>;
  info.kind = Kind::real;
  const Unit unit = info.unit;
  return {std::move(info), [member, unit](const Owner& owner) { return Value(to_file(member(owner), unit)); },
          [member, unit](Owner& owner, const Value& value) {
            member(owner) = to_inside<Field>(std::get<double>(value), unit);
          }};
}

/// Makes the real numbers of one table.
template <class Owner>
struct NumberOf {
  std::string_view table;

  /// `low` and `high` are in `unit`.
  template <class Member>
  Option<Owner> operator()(std::string_view key, std::string_view description, const Unit& unit, double low,
                           double high, Member member) const {
    return real<Owner>(
        {.table = table, .key = key, .description = description, .unit = unit, .low = low, .high = high}, member);
  }
};

template <class Owner, class Member>
Option<Owner> text(OptionInfo info, Member member) {
  info.kind = Kind::text;
  return {std::move(info),
          [member](const Owner& owner) {
            if constexpr (requires { member(owner).native(); }) {
              return Value(member(owner).native());
            } else {
              return Value(member(owner));
            }
          },
          [member](Owner& owner, const Value& value) { member(owner) = std::get<std::string>(value); }};
}

template <class Owner, class Member>
Option<Owner> choice(OptionInfo info, Member member) {
  using Field = std::remove_cvref_t<decltype(member(std::declval<Owner&>()))>;
  info.kind = Kind::choice;
  const auto choices = info.choices;
  return {std::move(info),
          [member, choices](const Owner& owner) {
            return Value(std::string(choices.at(static_cast<std::size_t>(member(owner)))));
          },
          [member, choices](Owner& owner, const Value& value) {
            for (std::size_t i = 0; i < choices.size(); ++i) {
              if (choices[i] == std::get<std::string>(value)) member(owner) = static_cast<Field>(i);
            }
          }};
}

/// A list of texts, which may be empty.
template <class Owner, class Member>
Option<Owner> list(OptionInfo info, Member member) {
  info.kind = Kind::list;
  return {
      std::move(info), [member](const Owner& owner) { return Value(member(owner)); },
      [member](Owner& owner, const Value& value) { member(owner) = std::get<std::vector<std::string>>(value); }};
}

template <class Owner, class Member>
Option<Owner> channels(OptionInfo info, Member member) {
  info.kind = Kind::channels;
  return {std::move(info),
          [member](const Owner& owner) {
            return Value(std::vector<double>(member(owner).begin(), member(owner).end()));
          },
          [member](Owner& owner, const Value& value) {
            const auto& given = std::get<std::vector<double>>(value);
            for (std::size_t i = 0; i < given.size(); ++i) member(owner).at(i) = given[i];
          }};
}

}  // namespace navcal::config
