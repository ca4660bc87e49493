// SPDX-License-Identifier: Apache-2.0
#include "web/http.h"

#include <boost/beast/http/field.hpp>

#include "record/json/json_members.h"

namespace navcal::web {
namespace http = boost::beast::http;
namespace {

int hexadecimal_digit(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return -1;
}

std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      const int high = hexadecimal_digit(text[i + 1]), low = hexadecimal_digit(text[i + 2]);
      if (high >= 0 && low >= 0) {
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
        continue;
      }
    }
    decoded += text[i] == '+' ? ' ' : text[i];
  }
  return decoded;
}

/// Styles may stand in the page itself, because the plots set them; nothing else does.
constexpr std::string_view kContentPolicy =
    "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; object-src 'none'; base-uri "
    "'self'";

}  // namespace

std::string_view path_of(std::string_view target) { return target.substr(0, target.find_first_of("?#")); }

std::string query_value(std::string_view target, std::string_view name) {
  const auto begin = target.find('?');
  if (begin == std::string_view::npos) return {};
  std::string_view query = target.substr(begin + 1);
  while (!query.empty()) {
    const auto end = query.find('&');
    const auto pair = query.substr(0, end);
    query.remove_prefix(end == std::string_view::npos ? query.size() : end + 1);
    const auto equals = pair.find('=');
    if (pair.substr(0, equals) != name) continue;
    return equals == std::string_view::npos ? std::string() : percent_decoded(pair.substr(equals + 1));
  }
  return {};
}

Response respond(http::status status, std::string_view content_type, std::string body) {
  Response response{status, 11};
  response.set(http::field::server, "navcal");
  response.set(http::field::content_type, beast_view(content_type));
  response.set(http::field::cache_control, "no-cache");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Content-Security-Policy", beast_view(kContentPolicy));
  response.set("Referrer-Policy", "no-referrer");
  response.body() = std::move(body);
  response.prepare_payload();
  return response;
}

Response respond_json(http::status status, std::string body) {
  return respond(status, "application/json", std::move(body));
}

Handler json_handler(std::string body) {
  return [body = std::move(body)](const Request&) -> boost::asio::awaitable<Response> {
    co_return respond_json(http::status::ok, body);
  };
}

std::string refusal(std::string_view why) { return record::json_text({{"ok", false}, {"error", why}}); }

Response refuse(http::status status, std::string_view why) { return respond_json(status, refusal(why) + "\n"); }

}  // namespace navcal::web
