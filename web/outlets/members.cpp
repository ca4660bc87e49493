// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/members.h"

#include <map>
#include <sstream>

#include "web/outlets/json_members.h"

namespace navcal::web {

const char* member_rows();  // members.txt

std::optional<double> Member::of(const nlohmann::json& message) const {
  const std::size_t begin = key.find('/') + 1;  // 0 without one
  const nlohmann::json& object = begin == 0 ? message : member_of(message, key.substr(0, begin - 1).c_str());
  const char* const name_in_it = key.c_str() + begin;
  const auto flag = flag_in(object, name_in_it);
  return flag ? flag : scaled(number_in(object, name_in_it), factor);
}

const Members& members_of(const std::string& message) {
  static const auto kAll = [] {
    std::map<std::string, Members> all;
    std::istringstream rows(member_rows());
    for (std::string row; std::getline(rows, row);) {
      if (row.starts_with('#')) continue;
      std::istringstream words(row);
      std::string of;
      Member member;
      words >> of >> member.key >> member.name >> member.factor >> member.unit >> std::ws;
      std::getline(words, member.help);
      all[of].push_back(std::move(member));
    }
    return all;
  }();
  return kAll.at(message);
}

}  // namespace navcal::web
