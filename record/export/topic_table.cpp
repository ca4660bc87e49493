// SPDX-License-Identifier: Apache-2.0
#include "record/export/topic_table.h"

#include <algorithm>
#include <array>
#include <functional>

#include "record/json/flat_json.h"
#include "record/json/mapping_json.h"
#include "record/log/checksum.h"

namespace navcal::record {
namespace {

constexpr Field kTimeField{"time", FieldKind::number, "s", "", "time", "time of validity"};
constexpr Field kJsonField{"json", FieldKind::text, "", "", "", "the message, a JSON object"};
constexpr std::array<std::string_view, 2> kUtc{"time", "arrival"};
constexpr std::array<std::string_view, 3> kIntervals{"monotonic", "offset", "at"};

template <class Names>
bool holds(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

TopicTable::Values values_for(const Field& field) {
  switch (field.kind) {
    case FieldKind::text: return TextColumn{};
    case FieldKind::boolean: return BooleanColumn{};
    case FieldKind::number:
    case FieldKind::vector3: break;
  }
  if (holds(kUtc, field.name)) return NanosecondColumn{{}, true};
  if (holds(kIntervals, field.name)) return NanosecondColumn{{}, false};
  return NumberColumn{};
}

}  // namespace

void TextColumn::append(std::string_view text) {
  const auto place = distinct_.try_emplace(std::string(text), distinct_.size()).first;
  rows_.push_back(&place->first);
  width_ = std::max(width_, text.size());
}

TopicTable::TopicTable(std::string_view topic) : topic_(topic) {
  const Topic* const listed = listed_topic(topic);
  listed_ = listed != nullptr;
  auto heads = listed_ ? topic_columns(*listed)
                       : std::vector<TopicColumn>{{"time_s", "time", &kTimeField}, {"json", "", &kJsonField}};
  for (auto& head : heads) {
    Values values = values_for(*head.field);
    columns_.push_back({std::move(head), std::move(values)});
  }
}

bool TopicTable::append(std::string_view json, std::int64_t log_utc_ns) {
  if (listed_) {
    const auto members = FlatJson::parse(json);
    if (!members) return false;
    for (Column& column : columns_) append(column, members->get(column.head.member));
  } else {
    append(columns_[0], {});
    append(columns_[1], std::string(json.substr(0, json.size() - kJsonTail)) + '}');
  }
  auto& time_ns = std::get<NanosecondColumn>(columns_.front().values).rows.back();
  if (time_ns == NanosecondColumn::kAbsent) time_ns = log_utc_ns;
  ++rows_;
  return true;
}

void TopicTable::append(Column& column, std::string_view text) {
  if (auto* numbers = std::get_if<NumberColumn>(&column.values)) {
    numbers->rows.push_back(number_or_nan(text));
  } else if (auto* times = std::get_if<NanosecondColumn>(&column.values)) {
    times->rows.push_back(nanoseconds(text).value_or(NanosecondColumn::kAbsent));
  } else if (auto* booleans = std::get_if<BooleanColumn>(&column.values)) {
    const std::int8_t value = text == "true" ? 1 : text == "false" ? 0 : BooleanColumn::kAbsent;
    booleans->rows.push_back(value);
  } else {
    std::get<TextColumn>(column.values).append(text);
  }
}

const std::vector<std::int64_t>& TopicTable::times_ns() const {
  return std::get<NanosecondColumn>(columns_.front().values).rows;
}

bool TopicTable::times_increase() const {
  const auto& times = times_ns();
  return std::ranges::adjacent_find(times, std::greater_equal<>{}) == times.end();
}

}  // namespace navcal::record
