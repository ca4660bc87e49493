// SPDX-License-Identifier: Apache-2.0
// The part of toml++ that is no template, compiled into navcald, for the reason that linked_fmt.cpp states.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
