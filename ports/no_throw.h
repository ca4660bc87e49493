// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/associated_executor.hpp>
#include <boost/asio/async_result.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/system/error_code.hpp>
#include <tuple>
#include <utility>

namespace navcal::ports {

/// Token for co_await: a failed operation returns its error code with its result, as a tuple, and throws nothing.
/// Asio's as_tuple(use_awaitable), which Boost 1.74 does not have.
struct NoThrow {};
inline constexpr NoThrow kNoThrow;

/// Hands the arguments of a completion on as one tuple, on the executor of the coroutine that waits.
template <typename Handler, typename... Results>
struct TupleHandler {
  using executor_type = boost::asio::associated_executor_t<Handler>;
  [[nodiscard]] executor_type get_executor() const noexcept {
    return boost::asio::get_associated_executor(handler);
  }
  void operator()(boost::system::error_code error, Results... results) {
    std::move(handler)(std::make_tuple(error, std::move(results)...));
  }

  Handler handler;
};

}  // namespace navcal::ports

// Beast gives an int where its own operation takes a size; in its headers the compiler does not mind.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"
template <typename... Results>
class boost::asio::async_result<navcal::ports::NoThrow, void(boost::system::error_code, Results...)> {
 public:
  template <typename Initiation, typename... Arguments>
  static auto initiate(Initiation initiation, navcal::ports::NoThrow, Arguments... arguments) {
    return async_initiate<const use_awaitable_t<>&, void(std::tuple<boost::system::error_code, Results...>)>(
        [initiation = std::move(initiation)](auto handler, auto... given) mutable {
          std::move(initiation)(navcal::ports::TupleHandler<decltype(handler), Results...>{std::move(handler)},
                                std::move(given)...);
        },
        use_awaitable, std::move(arguments)...);
  }
};
#pragma GCC diagnostic pop
