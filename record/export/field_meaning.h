// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace navcal::record {

/// Meaning of a column, in the terms of the CF conventions.
struct FieldMeaning {
  std::string_view topic;          ///< empty: wherever no line of its own stands
  std::string_view field;          ///< as Field::name
  std::string_view units;          ///< as UDUNITS reads them; empty of a text or a yes and no
  std::string_view standard_name;  ///< of the CF table; empty where it has none
  std::string_view long_name;
};

/// Null for a field that is not known.
[[nodiscard]] const FieldMeaning* field_meaning(std::string_view topic, std::string_view field);

}  // namespace navcal::record
