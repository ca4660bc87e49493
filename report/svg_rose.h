// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "calib/judgement.h"

namespace navcal::report {

/// Headings visited as a compass rose, north up. The radius of each sector is the root of its count, so that its
/// area shows the count.
[[nodiscard]] std::string svg_rose(const calib::HeadingHistogram& rose);

/// The same in one line of text, from north by east: '.' for a sector never visited, ':' for a seldom visited one.
[[nodiscard]] std::string text_rose(const calib::HeadingHistogram& rose);

}  // namespace navcal::report
