// SPDX-License-Identifier: Apache-2.0
#include "web/access.h"

#include <sys/stat.h>

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <boost/beast/core/string.hpp>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "base/line_reader.h"
#include "web/http.h"

namespace navcal::web {
namespace {

constexpr std::size_t kMinToken = 16;

/// Whatever the case of their letters.
bool is_same_word(std::string_view a, std::string_view b) {
  return boost::beast::iequals(beast_view(a), beast_view(b));
}

/// `host` without its port and brackets.
std::string_view name_of(std::string_view host) {
  if (host.starts_with('[')) return host.substr(1, host.find(']') - 1);
  return host.substr(0, host.find(':'));
}

bool is_this_computer(std::string_view name) {
  boost::system::error_code no_address;
  const std::string address = boost::asio::ip::make_address(std::string(name), no_address).to_string();
  if (no_address) return is_same_word(name, "localhost");
  return address == "::1" || address.starts_with("127.") || address.starts_with("::ffff:127.");
}

bool is_equal_in_constant_time(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = b.empty() ? '\0' : b[i % b.size()];
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned>(static_cast<unsigned char>(other));
  }
  return difference == 0;
}

}  // namespace

Access::Access(std::string token, std::vector<std::string> host_names, std::vector<std::string> origins)
    : token_(std::move(token)), host_names_(std::move(host_names)), origins_(std::move(origins)) {}

std::optional<std::string> Access::refusal(std::string_view authorization) const {
  constexpr std::string_view kBearer = "Bearer ";
  if (token_.empty()) return "this server may only be looked at: it was started without a token (--token-file)";
  if (!is_same_word(authorization.substr(0, kBearer.size()), kBearer))
    return "changing the vehicle needs the token: Authorization: Bearer TOKEN";
  if (!is_equal_in_constant_time(authorization.substr(kBearer.size()), token_)) return "wrong token";
  return std::nullopt;
}

bool Access::knows_host(std::string_view host) const {
  const std::string_view name = name_of(host);
  if (name.empty()) return false;
  boost::system::error_code not_an_address;
  [[maybe_unused]] const auto address = boost::asio::ip::make_address(std::string(name), not_an_address);
  if (!not_an_address) return true;
  if (name.find('.') == std::string_view::npos) return true;
  constexpr std::string_view kLocal = ".local";
  if (name.size() > kLocal.size() && is_same_word(name.substr(name.size() - kLocal.size()), kLocal)) return true;
  return std::ranges::any_of(host_names_, [name](const std::string& known) { return is_same_word(known, name); });
}

bool Access::knows_origin(std::string_view origin, std::string_view host) const {
  if (origin.empty()) return true;
  const auto scheme = origin.find("://");
  if (scheme != std::string_view::npos && is_same_word(origin.substr(scheme + 3), host)) return true;
  return std::ranges::any_of(origins_, [origin](const std::string& known) { return is_same_word(known, origin); });
}

bool is_from_here(std::string_view from, std::string_view host, std::string_view origin) {
  const auto scheme = origin.find("://");
  const bool is_own_page =
      origin.empty() || (scheme != std::string_view::npos && is_this_computer(name_of(origin.substr(scheme + 3))));
  return is_own_page && is_this_computer(from) && is_this_computer(name_of(host));
}

std::ifstream open_secret(const std::filesystem::path& file) {
  const auto failed = [&](const std::string& why) { return std::runtime_error(file.string() + ": " + why); };
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) throw failed(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) throw failed("not a file");
  if ((status.st_mode & (S_IROTH | S_IWOTH)) != 0)
    throw failed("everybody may read or write it; `chmod o-rw` keeps it secret");
  return std::ifstream(file);
}

std::string read_token(const std::filesystem::path& file) {
  const auto failed = [&](const std::string& why) { return std::runtime_error(file.string() + ": " + why); };
  std::ifstream in = open_secret(file);
  std::string token;
  if (!in || !std::getline(in, token)) throw failed("it cannot be read, or is empty");
  token = std::string(base::trimmed(token));
  if (token.size() < kMinToken)
    throw failed("the token has " + std::to_string(token.size()) + " characters, at least " +
                 std::to_string(kMinToken) + " are needed");
  return token;
}

}  // namespace navcal::web
