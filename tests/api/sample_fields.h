// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/samples.h>

#include <string>
#include <vector>

namespace navcal::api::test {

/// The lines of `navcal replay` that are samples.
[[nodiscard]] std::vector<std::string> sample_lines(const std::string& output);

/// Empty when a sample says what such a line says, to the last bit; else the first difference.
[[nodiscard]] std::string difference(const Sample& sample, const std::vector<Port>& ports,
                                     const std::string& line);

/// difference() of the first sample that has one, with the line; also of the numbers of samples.
[[nodiscard]] std::string difference(const std::vector<Sample>& samples, const std::vector<Port>& ports,
                                     const std::vector<std::string>& lines);

}  // namespace navcal::api::test
