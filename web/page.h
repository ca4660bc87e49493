// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "web/page_feed.h"
#include "web/site.h"

namespace navcal::web {

/// A track from a CSV file with a head line, as JSON for the page: with the columns `lat` and `lon` (degrees)
/// `{"unit":"deg","points":[[lat,lon],...]}`, with `x` and `y` (metres north and east of the start, as truth files
/// of navcal have them) `{"unit":"m","points":[[x,y],...]}`. At most 4000 points, evenly chosen. Throws
/// std::runtime_error, with the file's name and the line, when it cannot be read.
[[nodiscard]] std::string read_simulated_track(const std::filesystem::path& file);

/// Adds the page to a site: its files from `/` on, `/live`, `/live.json`, `/audit`, and `/track.json` of the CSV
/// file `track` where one is given. The site serves it as long as the feed lives. Throws std::runtime_error when
/// the track cannot be read.
[[nodiscard]] std::shared_ptr<PageFeed> add_page(Site& site, const boost::asio::any_io_executor& executor,
                                                 Hub& hub, PageFeed::Settings settings,
                                                 const std::filesystem::path& track = {});

}  // namespace navcal::web
