// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "record/log/mcap_format.h"

namespace navcal::record {

/// Takes a record's content apart field by field. Once something is missing, everything after it is too.
class McapFields {
 public:
  explicit McapFields(std::string_view content) : rest_(content) {}

  template <class Integer>
  Integer integer() {
    if (rest_.size() < sizeof(Integer)) return fail<Integer>();
    const auto value = read_le<Integer>(rest_, 0);
    rest_.remove_prefix(sizeof(Integer));
    return value;
  }
  std::string_view string() {
    const auto length = integer<std::uint32_t>();
    if (rest_.size() < length) return fail<std::string_view>();
    const std::string_view text = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return text;
  }
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  template <class T>
  T fail() {
    complete_ = false;
    rest_ = {};
    return T{};
  }

  std::string_view rest_;
  bool complete_ = true;
};

}  // namespace navcal::record
