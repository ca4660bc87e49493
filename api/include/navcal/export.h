// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks what the shared library exports. Everything else in it is hidden.
#define NAVCAL_API __attribute__((visibility("default")))
