// SPDX-License-Identifier: Apache-2.0
// The compiled part of Boost.Beast, once: every other source of this room only reads its declarations.
#include <boost/beast/src.hpp>
