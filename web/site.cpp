// SPDX-License-Identifier: Apache-2.0
#include "web/site.h"

#include <boost/beast/http/rfc7230.hpp>

namespace navcal::web {

void Site::add(std::string_view method, std::string path, Handler handler) {
  handlers_[{std::move(path), std::string(method)}] = std::move(handler);
}

const Handler* Site::handler(std::string_view method, std::string_view path, bool& path_exists) const {
  const std::string wanted(method == "HEAD" ? "GET" : method);
  const auto first = handlers_.lower_bound({std::string(path), std::string()});
  path_exists = first != handlers_.end() && first->first.first == path;
  const auto found = handlers_.find({std::string(path), wanted});
  return found == handlers_.end() ? nullptr : &found->second;
}

const WebSocketEndpoint* Site::endpoint(std::string_view path, std::string_view offered_subprotocols,
                                        std::string& chosen) const {
  chosen.clear();
  const boost::beast::http::token_list offered(beast_view(offered_subprotocols));
  const bool offers_any = offered.begin() != offered.end();
  for (const WebSocketEndpoint& endpoint : endpoints_) {
    if (endpoint.path != path) continue;
    if (endpoint.subprotocols.empty() && !offers_any) return &endpoint;
    // The client's order counts: it names first what it likes best.
    for (const auto& name : offered) {
      for (const std::string& known : endpoint.subprotocols) {
        if (std::string_view(name.data(), name.size()) != known) continue;
        chosen = known;
        return &endpoint;
      }
    }
  }
  return nullptr;
}

}  // namespace navcal::web
