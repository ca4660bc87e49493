// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "base/text_rows.h"
#include "config/option.h"

namespace navcal::config {

const char* option_rows();  // option_texts.txt

std::string_view option_text(std::string_view table, std::string_view key) {
  static const auto kAll = [] {
    const auto rows = base::text_rows(option_rows(), " ");
    return std::map<std::string, std::string_view, std::less<>>(rows.begin(), rows.end());
  }();
  return kAll.at(std::string(table) + (key.empty() ? "" : ".") + std::string(key));
}

}  // namespace navcal::config
