// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/complaints.h"
#include "config/document.h"
#include "config/option.h"

namespace navcal::config {

template <class Owner>
const Option<Owner>* find(const std::vector<Option<Owner>>& options, std::string_view table,
                          std::string_view key) {
  const auto found = std::find_if(options.begin(), options.end(), [&](const Option<Owner>& option) {
    return option.table == table && option.key == key;
  });
  return found == options.end() ? nullptr : &*found;
}

template <class Owner>
std::vector<std::string> keys_of(const std::vector<Option<Owner>>& options, std::string_view table) {
  std::vector<std::string> keys;
  for (const auto& option : options) {
    if (option.table == table) keys.emplace_back(option.key);
  }
  return keys;
}

template <class Owner>
std::vector<std::string> tables_of(const std::vector<Option<Owner>>& options) {
  std::vector<std::string> tables;
  for (const auto& option : options) {
    if (!option.table.empty() && (tables.empty() || tables.back() != option.table))
      tables.emplace_back(option.table);
  }
  return tables;
}

/// Options as text: line(option) of each, "" of those that are left out, and heading(table) before the first of a
/// table.
template <class Owner, class Heading, class Line>
std::string text_of(const std::vector<Option<Owner>>& options, Heading heading, Line line) {
  std::string out;
  std::string_view table;
  for (const auto& option : options) {
    const std::string text = option.moved_to.empty() ? line(option) : std::string();
    if (text.empty()) continue;
    if (option.table != table) out += heading(table = option.table);
    out += text;
  }
  return out;
}

/// The value in the option's own kind, or why not.
template <class Owner>
std::optional<std::string> set(const Option<Owner>& option, Owner& owner, const Entry& entry) {
  Value value = entry.plain_text && option.is_textual() ? Value(*entry.plain_text) : entry.value;
  auto refused = option.adopt(value);
  if (!refused) option.set(owner, value);
  return refused;
}

/// An entry TABLE.KEY or the table itself. What is wrong with it, or nullopt after setting it; what lies below
/// something wrong in a file has been complained of with that. `others`: tables that are known besides.
template <class Owner>
std::optional<std::string> take_entry(const std::vector<Option<Owner>>& options, Owner& owner, const Entry& entry,
                                      const std::vector<std::string>& others = {}) {
  const std::string& table = entry.keys.front();
  auto tables = tables_of(options);
  const bool below = entry.line != 0;
  if (std::find(tables.begin(), tables.end(), table) == tables.end()) {
    if (entry.keys.size() > 1 && below) return std::nullopt;
    tables.insert(tables.end(), others.begin(), others.end());
    return "unknown key" + suggestion(table, tables);
  }
  if (entry.keys.size() == 1) {
    if (std::holds_alternative<Table>(entry.value)) return std::nullopt;
    return "a table [" + table + "] is expected";
  }
  const auto* option = find(options, table, entry.keys[1]);
  if (option != nullptr && entry.keys.size() == 2) return set(*option, owner, entry);
  if (entry.keys.size() > 2 && below) return std::nullopt;
  return "unknown key" + suggestion(entry.keys[1], keys_of(options, table));
}

}  // namespace navcal::config
