// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "web/outlets/exposition.h"

namespace navcal::web {

/// CPU time, memory and descriptors of this process, by the names that all programs use for Prometheus.
void append_process(Exposition& out);

}  // namespace navcal::web
