// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "config/option.h"

namespace navcal::config {

const char* option_rows();  // option_texts.txt

std::string_view option_text(std::string_view table, std::string_view key) {
  static const auto kAll = [] {
    std::map<std::string, std::string_view, std::less<>> all;
    for (std::string_view rest = option_rows(); !rest.empty();) {
      const std::string_view row = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(rest.size(), row.size() + 1));
      all.emplace(row.substr(0, row.find(' ')), row.substr(row.find(' ') + 1));
    }
    return all;
  }();
  return kAll.at(std::string(table) + (key.empty() ? "" : ".") + std::string(key));
}

}  // namespace navcal::config
