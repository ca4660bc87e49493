// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <filesystem>
#include <memory>

#include "web/page_feed.h"
#include "web/site.h"

namespace navcal::web {

/// Adds the page to a site: its files from `/` on, `/live`, `/live.json`, and `/track.json` of the CSV file
/// `track` where one is given. The site serves it as long as the feed lives. Throws std::runtime_error when the
/// track cannot be read.
[[nodiscard]] std::shared_ptr<PageFeed> add_page(Site& site, const boost::asio::any_io_executor& executor,
                                                 Hub& hub, PageFeed::Settings settings,
                                                 const std::filesystem::path& track = {});

}  // namespace navcal::web
