// SPDX-License-Identifier: Apache-2.0
// First messages of control clients: without the token none is let in, and each is told why.
#include <boost/asio/io_context.hpp>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tests/fuzz/target.h"
#include "tests/web/foxglove_link.h"
#include "web/control_peer.h"

namespace navcal::fuzz::control_admission_target {

NAVCAL_FUZZ(control_admission) {
  using namespace navcal::web;
  static const Access access("the token that nobody guesses");
  boost::asio::io_context context;
  const auto endpoint = control_endpoint(context.get_executor(), "/control", "/nowhere", access);
  foxglove::FakeLink link;
  const auto peer = endpoint.make_peer(link, "/control");
  peer->on_open();
  peer->on_text({reinterpret_cast<const char*>(data), size});
  if (!link.is_closed || link.sent.size() != 1) std::abort();
  if (nlohmann::json::parse(*link.sent[0].bytes).at("ok") != false) std::abort();
  return 0;
}

}  // namespace navcal::fuzz::control_admission_target
