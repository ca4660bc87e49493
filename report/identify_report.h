// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "identify/answer/identification.h"

namespace navcal::report {

/// What navcal identify found: a table for people, one JSON object with a line end (docs/identify.md), and a page.
[[nodiscard]] std::string identify_text(const identify::Identification& found);
[[nodiscard]] std::string identify_json(const identify::Identification& found);
[[nodiscard]] std::string identify_page(const identify::Identification& found);

}  // namespace navcal::report
