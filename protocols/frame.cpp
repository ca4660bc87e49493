// SPDX-License-Identifier: Apache-2.0
#include "protocols/frame.h"

#include "protocols/device_types.h"

namespace navcal::protocols {

std::string_view name_of(Protocol protocol) {
  return static_cast<std::size_t>(protocol) < kDeviceCount ? device_type(protocol).name : "unknown";
}

std::optional<Protocol> protocol_named(std::string_view name) {
  for (const DeviceType& device : kDeviceTypes) {
    if (device.name == name) return device.protocol;
  }
  return std::nullopt;
}

}  // namespace navcal::protocols
