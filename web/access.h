// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::web {

/// Who may do what: looking is free to everybody who reaches the port, changing needs the token.
class Access {
 public:
  /// `token` empty: nobody may change anything. `host_names`: further names under which the server is reached.
  /// `origins`: other sites whose pages may connect, "https://example.org".
  explicit Access(std::string token = {}, std::vector<std::string> host_names = {},
                  std::vector<std::string> origins = {});

  /// Why a request with this Authorization header may not change the vehicle; nullopt when it may. Compares in
  /// constant time.
  [[nodiscard]] std::optional<std::string> refusal(std::string_view authorization) const;
  [[nodiscard]] bool can_change() const { return !token_.empty(); }

  /// False for a Host header under which this server is not reached. A page of another site that makes its own
  /// name point to this machine (DNS rebinding) is kept out by that. IP addresses, names without a dot, localhost,
  /// names in .local and the names given are taken.
  [[nodiscard]] bool knows_host(std::string_view host) const;
  /// True when a browser sends the request for a page of this server or of an allowed site: Origin is absent (no
  /// browser), names `host`, or is one of `origins`.
  [[nodiscard]] bool knows_origin(std::string_view origin, std::string_view host) const;

 private:
  std::string token_;
  std::vector<std::string> host_names_, origins_;
};

/// True for a request of this computer's address `from`, under a name that means this computer on each, and of no
/// page of another name: a proxy in front shows the names under which others reach it.
[[nodiscard]] bool is_from_here(std::string_view from, std::string_view host, std::string_view origin);

/// Throws std::runtime_error, with the file's name, when it is none, or when everybody may read or write it.
[[nodiscard]] std::ifstream open_secret(const std::filesystem::path& file);
/// The first line of a token file, without the blanks around it. Throws std::runtime_error, with the file's name,
/// when it cannot be read, as above, or when the token is shorter than 16 characters.
[[nodiscard]] std::string read_token(const std::filesystem::path& file);

}  // namespace navcal::web
