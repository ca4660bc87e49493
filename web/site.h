// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "web/http.h"
#include "web/peer.h"

namespace navcal::web {

/// What the server serves: handlers of paths and kinds of WebSocket clients.
class Site {
 public:
  /// `method` is GET or POST. HEAD is answered by GET's handler.
  void add(std::string_view method, std::string path, Handler handler);
  void add(WebSocketEndpoint endpoint) { endpoints_.push_back(std::move(endpoint)); }

  /// Null when nothing is served there. `path_exists` tells a wrong method from an unknown path.
  [[nodiscard]] const Handler* handler(std::string_view method, std::string_view path, bool& path_exists) const;
  /// Null when no endpoint serves such a client; `chosen` is the subprotocol to answer with, empty for none.
  [[nodiscard]] const WebSocketEndpoint* endpoint(std::string_view path, std::string_view offered_subprotocols,
                                                  std::string& chosen) const;

 private:
  std::map<std::pair<std::string, std::string>, Handler> handlers_;  ///< by path, method
  std::vector<WebSocketEndpoint> endpoints_;
};

}  // namespace navcal::web
