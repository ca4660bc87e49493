// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace navcal::web {

/// A track from a CSV file with a head line, as JSON for the page: with the columns `lat` and `lon` (degrees)
/// `{"unit":"deg","points":[[lat,lon],...]}`, with `x` and `y` (metres north and east of the start, as truth files
/// of navcal have them) `{"unit":"m","points":[[x,y],...]}`. At most 4000 points, evenly chosen. Throws
/// std::runtime_error, with the file's name and the line, when it cannot be read.
[[nodiscard]] std::string read_simulated_track(const std::filesystem::path& file);

}  // namespace navcal::web
