// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <functional>
#include <string_view>

namespace navcal::cli {

/// Hands on each line that comes in on a descriptor, to the end of it; nothing at all when it cannot be waited for
/// (a file, /dev/null). Leaves a terminal alone while it belongs to another program: reading would stop this one.
boost::asio::awaitable<void> read_lines(int fd, std::function<void(std::string_view)> on_line);

}  // namespace navcal::cli
