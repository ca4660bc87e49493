// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "web/hub.h"
#include "web/site.h"

namespace navcal::web {

class SignalKFeed;

/// Serves Signal K (docs/wires.md): discovery at /signalk, deltas at /signalk/v1/stream, and the context of this
/// vessel at /signalk/v1/api/self. While nobody is connected, nothing is asked of navcald for it.
class SignalK {
 public:
  /// `vessel`: the part after "vessels." of the context, such as "urn:mrn:imo:mmsi:230012345".
  SignalK(Hub& hub, Site& site, std::string vessel, std::string version);
  ~SignalK();
  SignalK(const SignalK&) = delete;
  SignalK& operator=(const SignalK&) = delete;

 private:
  std::shared_ptr<SignalKFeed> feed_;  ///< shared with the clients, which may outlive this object
};

/// A name that stays the same on this machine: derived from /etc/machine-id, which it does not disclose. Random
/// where there is no such file.
[[nodiscard]] std::string default_vessel();
/// Why `vessel` is no name of a vessel in Signal K; empty when it is one.
[[nodiscard]] std::string problem_of_vessel(const std::string& vessel);
/// The answer to `GET /signalk`. `host`: the Host header of the request.
[[nodiscard]] std::string signalk_discovery(std::string_view host, std::string_view version);

}  // namespace navcal::web
