// SPDX-License-Identifier: Apache-2.0
#include "web/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "web/audit_peer.h"
#include "web/page_files.h"

namespace navcal::web {
namespace {

constexpr std::size_t kMaxTrackPoints = 4000;

std::vector<std::string_view> cells_of(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string_view> cells;
  for (;;) {
    const auto end = line.find(',');
    cells.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

/// NaN when the cell is not there or no number.
double cell_number(const std::vector<std::string_view>& cells, std::size_t column) {
  double value = std::nan("");
  if (column < cells.size())
    std::from_chars(cells[column].data(), cells[column].data() + cells[column].size(), value);
  return value;
}

}  // namespace

std::string read_simulated_track(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) throw std::runtime_error(file.string() + ": it cannot be read, or is empty");
  const auto head = cells_of(line);
  const auto column = [&head](std::string_view name) {
    return static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin());
  };
  const bool is_geographic = column("lat") < head.size() && column("lon") < head.size();
  const std::size_t first = column(is_geographic ? "lat" : "x"), second = column(is_geographic ? "lon" : "y");
  if (first >= head.size() || second >= head.size())
    throw std::runtime_error(file.string() + " line 1: it needs the columns x and y, or lat and lon");
  std::vector<std::pair<double, double>> points;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    const auto cells = cells_of(line);
    const double a = cell_number(cells, first), b = cell_number(cells, second);
    if (!std::isfinite(a) || !std::isfinite(b))
      throw std::runtime_error(fmt::format("{} line {}: no number for the place", file.string(), number));
    points.emplace_back(a, b);
  }
  const std::size_t step = points.size() / kMaxTrackPoints + 1;
  std::string out = fmt::format(R"({{"unit":"{}","points":[)", is_geographic ? "deg" : "m");
  for (std::size_t i = 0; i < points.size(); i += step) {
    fmt::format_to(std::back_inserter(out), "{}[{:.7f},{:.7f}]", i == 0 ? "" : ",", points[i].first,
                   points[i].second);
  }
  return out + "]}";
}

namespace asio = boost::asio;
namespace http = boost::beast::http;

namespace {

std::string_view type_of(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  if (name.ends_with(".svg")) return "image/svg+xml";
  return "text/plain; charset=utf-8";
}

/// The browser asks each time whether its copy is still good, and gets the bytes only when it is not.
Handler file_handler(const PageFile& file) {
  const std::string tag = fmt::format("\"{:x}\"", std::hash<std::string_view>{}(file.bytes));
  return [file, tag](const Request& request) -> asio::awaitable<Response> {
    const auto known = request[http::field::if_none_match];
    const bool is_known = std::string_view(known.data(), known.size()) == tag;
    Response response = respond(is_known ? http::status::not_modified : http::status::ok, type_of(file.name),
                                is_known ? std::string() : std::string(file.bytes));
    response.set(http::field::etag, tag);
    co_return response;
  };
}

}  // namespace

std::shared_ptr<PageFeed> add_page(Site& site, const asio::any_io_executor& executor, Hub& hub,
                                   PageFeed::Settings settings, const std::filesystem::path& track) {
  for (const PageFile& file : page_files()) {
    site.add("GET", fmt::format("/{}", file.name), file_handler(file));
    if (file.name == "index.html") site.add("GET", "/", file_handler(file));
  }
  settings.has_track = !track.empty();
  if (settings.has_track) site.add("GET", "/track.json", json_handler(read_simulated_track(track)));
  auto feed = std::make_shared<PageFeed>(executor, hub, std::move(settings));
  const std::weak_ptr<PageFeed> weak = feed;
  site.add("GET", "/live.json", [weak](const Request&) -> asio::awaitable<Response> {
    const auto living = weak.lock();
    if (!living) co_return refuse(http::status::service_unavailable, "the server stops");
    co_return respond_json(http::status::ok, *living->snapshot());
  });
  site.add({.path = "/live", .make_peer = [weak](PeerLink& link, std::string_view) {
              return PageFeed::make_viewer(weak.lock(), link);
            }});
  site.add(audit_endpoint(executor));
  return feed;
}

}  // namespace navcal::web
