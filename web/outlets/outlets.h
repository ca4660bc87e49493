// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "web/http.h"
#include "web/hub.h"
#include "web/live_source.h"
#include "web/outlets/outlet_options.h"
#include "web/server.h"
#include "web/site.h"

namespace navcal::web {

/// How BlueOS finds the page of a container: the answer to `GET /register_service`, by its ServiceMetadata.
[[nodiscard]] std::string blueos_service(std::string_view version);

/// All that other programs are served with (docs/wires.md), in one place.
class Outlets {
 public:
  /// Adds its paths to `site`. Throws std::runtime_error, which says what to do, when an option cannot be
  /// followed.
  Outlets(const boost::asio::any_io_executor& executor, const OutletOptions& options, Hub& hub, Site& site);
  ~Outlets();
  Outlets(const Outlets&) = delete;
  Outlets& operator=(const Outlets&) = delete;

  /// From now on `GET /metrics` tells of these, too. They must live as long as the server.
  void watch(const ServerCounters& server, const LiveSource::Counters& source);
  /// Says good-bye where a protocol wants it.
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace navcal::web
