// SPDX-License-Identifier: Apache-2.0
#include "web/page.h"

#include <fmt/format.h>

#include <functional>

#include "web/page_files.h"
#include "web/simulated_track.h"

namespace navcal::web {
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

Handler text_handler(std::shared_ptr<const std::string> json) {
  return [json = std::move(json)](const Request&) -> asio::awaitable<Response> {
    co_return respond_json(http::status::ok, *json);
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
  if (settings.has_track)
    site.add("GET", "/track.json", text_handler(std::make_shared<const std::string>(read_simulated_track(track))));
  const auto feed = std::make_shared<PageFeed>(executor, hub, std::move(settings));
  const std::weak_ptr<PageFeed> weak = feed;
  site.add("GET", "/live.json", [weak](const Request&) -> asio::awaitable<Response> {
    const auto living = weak.lock();
    if (!living) co_return refuse(http::status::service_unavailable, "the server stops");
    co_return respond_json(http::status::ok, *living->snapshot());
  });
  WebSocketEndpoint live;
  live.path = "/live";
  live.make_peer = [weak](PeerLink& link, std::string_view) { return PageFeed::make_viewer(weak.lock(), link); };
  site.add(std::move(live));
  return feed;
}

}  // namespace navcal::web
