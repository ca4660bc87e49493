// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <functional>
#include <string>
#include <string_view>

namespace navcal::web {

using Request = boost::beast::http::request<boost::beast::http::string_body>;
using Response = boost::beast::http::response<boost::beast::http::string_body>;

/// Beast of Boost 1.74 (Debian 12) has a string view of its own.
[[nodiscard]] inline boost::beast::string_view beast_view(std::string_view text) {
  return {text.data(), text.size()};
}

/// Answers one request. It may wait, for example for navcald.
using Handler = std::function<boost::asio::awaitable<Response>(const Request&)>;

/// Path of a request target, without its query.
[[nodiscard]] std::string_view path_of(std::string_view target);
/// Value of `name` in the query of a request target, percent-decoded; empty when it is absent.
[[nodiscard]] std::string query_value(std::string_view target, std::string_view name);

/// A whole answer. It forbids what a page of navcal never needs: other sites' scripts, and guesses of the type.
[[nodiscard]] Response respond(boost::beast::http::status status, std::string_view content_type, std::string body);
[[nodiscard]] Response respond_json(boost::beast::http::status status, std::string body);
/// Answers every request with this JSON.
[[nodiscard]] Handler json_handler(std::string body);
/// `{"ok":false,"error":why}`, as navcald's control socket refuses.
[[nodiscard]] std::string refusal(std::string_view why);
[[nodiscard]] Response refuse(boost::beast::http::status status, std::string_view why);

}  // namespace navcal::web
