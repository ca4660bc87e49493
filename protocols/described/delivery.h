// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/described/description.h"
#include "protocols/device_types.h"

namespace navcal::protocols::described {

/// What a device with this description measures.
[[nodiscard]] Delivery delivery_of(const Description& description);

}  // namespace navcal::protocols::described
